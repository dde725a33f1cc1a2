// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <CLI/Formatter.hpp>
#include <string>

#include "arguments.hpp"

namespace impinge::cli {

/// The arguments of every command; only those of the command that is given are filled in.
struct AllArguments {
  CheckArguments check;
  ClashArguments clash;
  MotionArguments motion;
  ImpactsArguments impacts;
  ViewArguments view;
  InfoArguments info;
};

/// Declares all commands and their options. Parsing writes into `to` and throws `CLI::ParseError` with a sentence.
void add_commands(CLI::App& program, AllArguments& to);

/// What a help page says around the list of options. The first line of `about` stands in the list of commands too.
struct HelpPage {
  std::string about, end;
};

extern const HelpPage kProgramHelp, kCheckHelp, kClashHelp, kMotionHelp, kImpactsHelp, kViewHelp, kInfoHelp,
    kDevicesHelp;

/// CLI11's help pages with descriptions that are broken to fit 80 columns.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace impinge::cli
