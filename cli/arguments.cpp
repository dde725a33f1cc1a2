// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "arguments.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

#include "command_options.hpp"
#include "help.hpp"
#include "impinge/version.hpp"
#include "option_values.hpp"
#include "report/sink.hpp"
#include "report/text.hpp"

namespace impinge::cli {
namespace {

struct Parser {
  CLI::App app{"impinge", "impinge"};
  CLI::App* check = nullptr;
  CLI::App* clash = nullptr;
  CLI::App* motion = nullptr;
  CLI::App* view = nullptr;
  CLI::App* info = nullptr;
  CLI::App* devices = nullptr;

  [[nodiscard]] std::array<const CLI::App*, 6> commands() const { return {check, clash, motion, view, info, devices}; }

  /// The command that the user is in; null before one is named.
  [[nodiscard]] const CLI::App* command() const {
    const std::vector<CLI::App*> parsed = app.get_subcommands();
    return parsed.empty() ? nullptr : parsed.front();
  }

  /// The same, or the program itself.
  [[nodiscard]] const CLI::App& innermost() const {
    const CLI::App* const named = command();
    return named != nullptr ? *named : app;
  }
};

std::vector<HelpEntry> options_of(const CLI::App& command) {
  std::vector<HelpEntry> entries;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) continue;
    const std::string value = option->get_type_size_max() > 0 ? " " + option->get_type_name() : "";
    entries.push_back({"--" + option->get_lnames().front() + value, option->get_description()});
  }
  // CLI11 begins with --help; people look for what the program can do first.
  std::rotate(entries.begin(), entries.begin() + 1, entries.end());
  return entries;
}

std::string help_page(const Parser& parser) {
  const std::size_t width = width_of(STDOUT_FILENO).value_or(80);
  const CLI::App* const command = parser.command();
  if (command == nullptr) return general_help(width);
  if (command == parser.check) return check_help(options_of(*command), width);
  if (command == parser.clash) return clash_help(options_of(*command), width);
  if (command == parser.motion) return motion_help(options_of(*command), width);
  if (command == parser.view) return view_help(options_of(*command), width);
  if (command == parser.info) return info_help(options_of(*command), width);
  return devices_help(width);
}

/// What shows the help of where the user is.
std::string help_command(const Parser& parser) {
  return parser.command() == nullptr ? "impinge --help" : "impinge " + parser.command()->get_name() + " --help";
}

/// The candidate that is nearest to the word: what the word begins, or what differs from it in few letters. Or nothing.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  const auto letters =
      static_cast<std::size_t>(std::count_if(word.begin(), word.end(), [](char c) { return c != '-'; }));
  std::size_t least = std::min<std::size_t>((letters + 1) / 2, 3) + 1;  // of two words so far apart neither is a slip
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

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
  return names;
}

/// "impinge clash, motion and view": the commands that have this option; empty if none has.
std::string commands_with(const Parser& parser, const std::string& option) {
  std::vector<std::string> names;
  for (const CLI::App* command : parser.commands()) {
    const std::vector<std::string> options = option_names(*command);
    if (std::find(options.begin(), options.end(), option) != options.end()) names.push_back(command->get_name());
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "impinge " : i + 1 < names.size() ? ", " : " and ") + names[i];
  return text.empty() ? text : text + (names.size() == 1 ? " has it" : " have it");
}

Error unknown_option(const Parser& parser, const std::string& word) {
  const CLI::App& command = parser.innermost();
  // An option and its value may have come as one word.
  const std::string name = word.substr(0, word.find('='));
  const std::vector<std::string> known = option_names(command);
  if (std::find(known.begin(), known.end(), name) != known.end())
    return bad_option(fmt::format("'{}' stands before the command; options come after it, as in impinge {} FILE... {}",
                                  name, command.get_name(), name));
  std::string mend = commands_with(parser, name);
  if (mend.empty()) {
    mend = nearest(name, known);
    if (!mend.empty()) mend = fmt::format("did you mean {}?", mend);
  }
  return bad_option(fmt::format("there is no option '{}' here{}; see {}", name,
                                mend.empty() ? "" : fmt::format(" ({})", mend), help_command(parser)));
}

Error unexpected(const Parser& parser, const std::string& word) {
  if (word.starts_with('-')) return unknown_option(parser, word);
  if (parser.command() != nullptr && parser.command() != parser.devices)
    return bad_option(
        fmt::format("'{0}' stands before the command; write impinge {1} {0}", word, parser.command()->get_name()));
  if (parser.command() != nullptr)
    return bad_option("impinge devices takes no file, and no word such as '" + word + "'");
  std::vector<std::string> commands;
  for (const CLI::App* command : parser.commands()) commands.push_back(command->get_name());
  const std::string meant = nearest(word, commands);
  return bad_option(
      fmt::format("there is no command '{}'{}; impinge check FILE... finds what touches, impinge --help tells more",
                  word, meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant)));
}

/// The words that no command and no option took.
std::vector<std::string> extras(const Parser& parser) {
  std::vector<std::string> words = parser.app.remaining(true);
  // CLI11 counts the mark after which all words are files among them.
  std::erase(words, "--");
  return words;
}

/// CLI11 says "--limit: At Most 1 required but received 2", "--json: 1 required FILE missing" and "Could not convert:
/// --first = maybe".
std::string in_plain_words(const Parser& parser, const CLI::ParseError& error) {
  std::string text = error.what();
  const CLI::App& command = parser.innermost();
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_lnames().empty()) continue;
    std::string name = "--" + option->get_lnames().front();
    if (error.get_name() == "ConversionError" && text.find(name + " =") != std::string::npos)
      return name + " takes no value";
    if (error.get_name() != "ArgumentMismatch" || !text.starts_with(name + ":")) continue;
    return option->count() > 1 ? name + " is given more than once"
                               : fmt::format("{} needs {} after it", name, option->get_type_name());
  }
  return text;
}

/// `--limit=` with nothing after it: CLI11 would take the next word as the value, and it may be a file. And
/// `--clearance "$UNSET"`, which would silently be as if it were not there.
Result<void> refuse_empty_values(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word(argv[i]);
    if (word == "--") break;
    if (word.starts_with("--") && word.ends_with('=') && word.find('=') == word.size() - 1)
      return bad_option(fmt::format("'{}' has no value after the '='", word));
    if (word.starts_with("--") && i + 1 < argc && *argv[i + 1] == '\0')
      return bad_option(fmt::format("the value after '{}' is empty; leave both out, or give one", word));
  }
  return {};
}

}  // namespace

Result<Command> parse_command_line(int argc, const char* const* argv) {
  Raw raw;
  Parser parser;
  parser.app.set_help_flag("--help,-h", "this page");
  parser.app.set_version_flag("--version", "impinge " IMPINGE_VERSION);
  parser.app.allow_extras();
  parser.check = parser.app.add_subcommand("check")->allow_extras();
  parser.clash = parser.app.add_subcommand("clash")->allow_extras();
  parser.motion = parser.app.add_subcommand("motion")->allow_extras();
  parser.view = parser.app.add_subcommand("view")->allow_extras();
  parser.info = parser.app.add_subcommand("info")->allow_extras();
  parser.devices = parser.app.add_subcommand("devices")->allow_extras();
  parser.devices->set_help_flag("--help,-h", "this page");
  add_check(*parser.check, raw);
  add_clash(*parser.clash, raw);
  add_motion(*parser.motion, raw);
  add_view(*parser.view, raw);
  add_info(*parser.info, raw);

  if (auto refused = refuse_empty_values(argc, argv); !refused) return refused.error();
  try {
    parser.app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return Command(Notice{help_page(parser)});
  } catch (const CLI::CallForVersion& version) {
    return Command(Notice{std::string(version.what()) + "\n"});
  } catch (const CLI::RequiredError&) {
    // The only thing required is FILE.
    if (const auto extra = extras(parser); !extra.empty()) return unexpected(parser, extra.front());
    return bad_option("no file to read is named; see " + help_command(parser));
  } catch (const CLI::RequiresError&) {
    // The only thing that requires another is --triangles.
    return bad_option("--triangles goes into the JSON: name its file with --json FILE");
  } catch (const CLI::ParseError& error) {
    return bad_option(fmt::format("{}; see {}", in_plain_words(parser, error), help_command(parser)));
  }
  if (const auto extra = extras(parser); !extra.empty()) return unexpected(parser, extra.front());
  if (parser.app.get_subcommands().size() > 1)
    return bad_option("check, clash, motion, view, info and devices cannot be asked for at once");
  if (parser.check->parsed()) return take_check(std::move(raw));
  if (parser.clash->parsed()) return take_clash(std::move(raw));
  if (parser.motion->parsed()) return take_motion(std::move(raw));
  if (parser.view->parsed()) return take_view(std::move(raw));
  if (parser.info->parsed()) return take_info(std::move(raw));
  if (parser.devices->parsed()) return Command(DevicesArguments{});
  return bad_option("no command is given; impinge check FILE... finds what touches, impinge --help tells more");
}

}  // namespace impinge::cli
