// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "command_options.hpp"

namespace impinge::cli {

/// The files for other tools, with their units and dates. Errors: `bad_option`.
Result<void> take_exports(const Raw& raw, ExportArguments& to);

}  // namespace impinge::cli
