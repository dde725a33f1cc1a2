// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "arguments.hpp"

namespace impinge::cli {

/// `impinge info`: false where a file could not be read; why has then been said on standard error, and the others are
/// listed. Errors: everything else that ends the command with exit code 2.
Result<bool> info(const InfoArguments& arguments, const std::stop_token& stop);

}  // namespace impinge::cli
