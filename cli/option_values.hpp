// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "command_options.hpp"

namespace impinge::cli {

/// A command's arguments, from the texts that were given. Errors: `bad_option`, with a sentence that names the option.
Result<Command> take_check(Raw raw);
Result<Command> take_clash(Raw raw);
Result<Command> take_motion(Raw raw);
Result<Command> take_view(Raw raw);
Result<Command> take_info(Raw raw);

}  // namespace impinge::cli
