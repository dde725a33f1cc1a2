// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

#include "arguments.hpp"

namespace impinge::cli {

/// The arguments of every command; only those of the command that is given are filled in.
struct AllArguments {
  CheckArguments check;
  ClashArguments clash;
  MotionArguments motion;
  ViewArguments view;
  InfoArguments info;
};

/// Declares all commands and their options. Parsing writes into `to` and throws `CLI::ParseError` with a sentence.
void add_commands(CLI::App& program, AllArguments& to);

}  // namespace impinge::cli
