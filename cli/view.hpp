// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "arguments.hpp"

namespace impinge::cli {

/// `impinge view`: a page that shows the assembly. Errors: those of reading and writing; `cancelled`.
Result<void> view(const ViewArguments& arguments, const std::stop_token& stop);

}  // namespace impinge::cli
