// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

/// The help pages: what the program tells about itself, laid out for the width of the terminal.
namespace impinge::cli {

/// A left part that is never broken and its explanation.
struct HelpEntry {
  std::string left;
  std::string explanation;
};

std::string general_help(std::size_t width);
/// `options` are those that the command line knows, so that the page lists no other and forgets none.
std::string check_help(const std::vector<HelpEntry>& options, std::size_t width);
std::string clash_help(const std::vector<HelpEntry>& options, std::size_t width);
std::string motion_help(const std::vector<HelpEntry>& options, std::size_t width);
std::string view_help(const std::vector<HelpEntry>& options, std::size_t width);
std::string info_help(const std::vector<HelpEntry>& options, std::size_t width);

std::string devices_help(std::size_t width);

}  // namespace impinge::cli
