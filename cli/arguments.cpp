// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "command_options.hpp"
#include "impinge/version.hpp"
#include "report/text.hpp"

namespace impinge::cli {
namespace {

Error bad_option(std::string sentence) { return {Code::bad_option, std::move(sentence)}; }

/// The candidate that begins with the word, or else differs from it in the fewest letters; empty if it differs in many.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  const auto letters =
      static_cast<std::size_t>(std::count_if(word.begin(), word.end(), [](char c) { return c != '-'; }));
  std::size_t least = std::min<std::size_t>((letters + 1) / 2, 3) + 1;  // two words so far apart are no slip
  std::string found;
  for (const std::string& candidate : candidates) {
    const bool is_begun = letters > 1 && candidate.starts_with(word);
    const std::size_t distance = is_begun ? 0 : edit_distance(word, candidate);
    if (distance >= least) continue;
    least = distance;
    found = candidate;
  }
  return found;
}

/// The words that call a command, such as "impinge clash".
std::string name_of(const CLI::App& command) {
  return command.get_parent() == nullptr ? "impinge" : "impinge " + command.get_name();
}

/// The first word of the command line that is no option, command or file; empty if there is none.
std::string first_unknown(const CLI::App& command) {
  for (const std::string& word : command.remaining())
    if (word != "--") return word;  // CLI11 keeps the mark after which all words are files
  return {};
}

std::string about_unknown(const CLI::App& command, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_lnames().empty()) known.push_back("--" + option->get_lnames().front());
  for (const CLI::App* inner : command.get_subcommands({})) known.push_back(inner->get_name());
  const std::string meant = nearest(name, known);
  return fmt::format("'{}' is no {} of {}{}", name, name.starts_with('-') ? "option" : "command", name_of(command),
                     meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant));
}

/// `--json= a.obj` and `--json "$UNSET"`: CLI11 takes the next word for the value of the first, and the second as if it
/// were not there.
Result<void> refuse_empty_values(int argc, const char* const* argv) {
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    const std::string_view word(argv[i]);
    const bool is_empty = i + 1 < argc && *argv[i + 1] == '\0';
    if (word.starts_with("--") && (is_empty || word.find('=') == word.size() - 1))
      return bad_option(fmt::format("the value of '{}' is empty; leave both out, or give one", word));
  }
  return {};
}

}  // namespace

Result<Command> parse_command_line(int argc, const char* const* argv) {
  if (auto refused = refuse_empty_values(argc, argv); !refused) return refused.error();
  AllArguments all;
  CLI::App app(kProgramHelp.about, "impinge");
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag("-h,--help", "print this page");
  app.set_version_flag("--version", "impinge " IMPINGE_VERSION, "print which version this is");
  app.footer(kProgramHelp.end);
  app.require_subcommand(1);
  add_commands(app, all);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return Command(Notice{app.help()});
  } catch (const CLI::CallForVersion& version) {
    return Command(Notice{std::string(version.what()) + "\n"});
  } catch (const CLI::ParseError& error) {
    const auto commands = app.get_subcommands();
    const CLI::App& command = commands.empty() || !first_unknown(app).empty() ? app : *commands.front();
    const std::string unknown = first_unknown(command);
    return bad_option(fmt::format("{}; see {} --help", unknown.empty() ? error.what() : about_unknown(command, unknown),
                                  name_of(command)));
  }
  const std::string name = app.get_subcommands().front()->get_name();
  if (name == "check") return Command(std::move(all.check));
  if (name == "clash") return Command(std::move(all.clash));
  if (name == "motion") return Command(std::move(all.motion));
  if (name == "impacts") return Command(std::move(all.impacts));
  if (name == "view") return Command(std::move(all.view));
  if (name == "info") return Command(std::move(all.info));
  return Command(DevicesArguments{});
}

}  // namespace impinge::cli
