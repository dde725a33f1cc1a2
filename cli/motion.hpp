// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "arguments.hpp"

namespace impinge::cli {

/// `impinge motion`: when the parts of an animated file clash. True: some do. Errors: those of reading and writing;
/// `bad_file` (no animation), `bad_option` (none of that name), `cancelled`.
Result<bool> motion(const MotionArguments& arguments, const std::stop_token& stop);

}  // namespace impinge::cli
