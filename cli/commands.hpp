// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "arguments.hpp"

/// The commands: each reads the files, writes what it is asked for and prints its table. Their errors are all that end
/// the program with exit code 2.
namespace impinge::cli {

/// Whether any two objects touch.
Result<bool> check(const CheckArguments& arguments, const std::stop_token& stop);

/// Whether any pair of parts fails: whether its verdict is one that `--fail-on` names, or the mode of its test.
Result<bool> clash(const ClashArguments& arguments, const std::stop_token& stop);

/// Whether any parts clash at any time of the animation.
Result<bool> motion(const MotionArguments& arguments, const std::stop_token& stop);

/// Whether anything meets on the way from one of the states to the next.
Result<bool> impacts(const ImpactsArguments& arguments, const std::stop_token& stop);

Result<void> view(const ViewArguments& arguments, const std::stop_token& stop);

/// Whether all files could be read; each error has then been printed, and the other files are listed.
Result<bool> info(const InfoArguments& arguments, const std::stop_token& stop);

/// Whether there is a device that can be used.
Result<bool> list_devices();

}  // namespace impinge::cli
