// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "arguments.hpp"

namespace impinge::cli {

/// `impinge clash`: whether anything is what `--fail-on` names. Errors: everything that ends the command with exit code
/// 2.
Result<bool> clash(const ClashArguments& arguments, const std::stop_token& stop);

}  // namespace impinge::cli
