// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "arguments.hpp"

namespace impinge::cli {

/// `impinge check`: whether anything touches. Errors: everything that ends the command with exit code 2.
Result<bool> check(const CheckArguments& arguments, const std::stop_token& stop);

}  // namespace impinge::cli
