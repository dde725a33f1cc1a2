// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "arguments.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <string_view>

#include "help.hpp"
#include "impinge/version.hpp"
#include "numbers.hpp"
#include "sink.hpp"
#include "text.hpp"

namespace impinge::cli {
namespace {

/// What CLI11 fills in: numbers stay texts, so that this program says what is wrong with them.
struct Raw {
  CheckArguments check;
  InfoArguments info;
  std::string json, limit, threads, max_file, device_share;
  std::vector<std::string> ignored, scales;
};

struct Parser {
  CLI::App app{"impinge", "impinge"};
  CLI::App* check = nullptr;
  CLI::App* info = nullptr;
  CLI::App* devices = nullptr;
};

Error bad(std::string sentence) { return {Code::bad_option, std::move(sentence)}; }

void add_files(CLI::App& command, std::vector<std::string>& files) {
  command.set_help_flag("--help,-h", "this page");
  command.add_option("FILE", files, "")->required()->type_name("");
}

void add_json(CLI::App& command, Raw& raw, const std::string& what) {
  command
      .add_option("--json", raw.json,
                  "write the " + what + " as JSON to a file, or to standard output (-) in place of the table")
      ->type_name("FILE|-");
}

void add_max_file(CLI::App& command, Raw& raw) {
  command.add_option("--max-file", raw.max_file, "refuse larger files unread: bytes, or 500M, 2G (default: 2G)")
      ->type_name("BYTES");
}

void add_check(CLI::App& command, Raw& raw) {
  CheckArguments& to = raw.check;
  add_files(command, to.files);
  add_json(command, raw, "answer");
  command.add_flag("--triangles", to.triangles, "list every pair of triangles in the JSON")->needs("--json");
  command.add_flag("--first", to.first,
                   "only whether objects touch, with one pair of triangles as the witness; faster, and without a hash");
  command
      .add_option("--limit", raw.limit, "keep only the first N pairs of triangles, in order of objects and triangles")
      ->type_name("N");
  command.add_option("--threads", raw.threads, "work on N threads, 0 for as many as the machine has (default: 0)")
      ->type_name("N");
  command
      .add_option(
          "--backend", to.backend,
          "what does the work: auto (simd), simd, scalar (the plain reference), gpu (a device), raster (the "
          "paper's way: a device draws the tests), or hybrid (a device and the CPU together); the answer is the "
          "same")
      ->type_name("NAME");
  command
      .add_option(
          "--device", to.device,
          "which device gpu, raster and hybrid use: its number or part of its name, see impinge devices (default: "
          "IMPINGE_DEVICE, or the first)")
      ->type_name("N|NAME");
  command
      .add_option("--device-share", raw.device_share,
                  "how much of the work hybrid gives to the device, from 0 to 1 (default: what ends soonest)")
      ->type_name("S");
  command
      .add_option("--ignore", raw.ignored,
                  "leave out all pairs of an object named A and one named B; * stands for any characters, ? for one; "
                  "may be given again")
      ->type_name("A B")
      ->type_size(2)
      ->allow_extra_args(false);
  command.add_option("--scale", raw.scales, "multiply the coordinates of one of the files by S; may be given again")
      ->type_name("FILE=S")
      ->allow_extra_args(false);
  add_max_file(command, raw);
  command.add_flag("--quiet", to.quiet, "print no table, no progress and no warnings");
  command.add_flag("--stats", to.stats, "print what was done at each stage, and the time predicted and measured");
}

void add_info(CLI::App& command, Raw& raw) {
  add_files(command, raw.info.files);
  add_json(command, raw, "list");
  add_max_file(command, raw);
}

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
  if (parser.check->parsed()) return check_help(options_of(*parser.check), width);
  if (parser.info->parsed()) return info_help(options_of(*parser.info), width);
  if (parser.devices->parsed()) return devices_help(width);
  return general_help(width);
}

/// The command that the user is in, as he would ask for its help.
std::string help_command(const Parser& parser) {
  if (parser.check->parsed()) return "impinge check --help";
  if (parser.info->parsed()) return "impinge info --help";
  if (parser.devices->parsed()) return "impinge devices --help";
  return "impinge --help";
}

Error unexpected(const Parser& parser, const std::string& word) {
  const bool in_command = parser.check->parsed() || parser.info->parsed() || parser.devices->parsed();
  const bool option = word.starts_with('-');
  if (!in_command && !option) {
    return bad(fmt::format(
        "there is no command '{}'; impinge check FILE... finds what touches, impinge --help tells more", word));
  }
  if (parser.devices->parsed() && !option)
    return bad("impinge devices takes no file, and no word such as '" + word + "'");
  // An option and its value may have come as one word.
  const std::string name = word.substr(0, word.find('='));
  std::string nearest;
  std::size_t distance = 4;
  for (const CLI::App* command :
       {static_cast<const CLI::App*>(parser.check), static_cast<const CLI::App*>(parser.info)}) {
    if (!option || !command->parsed()) continue;
    for (const CLI::Option* known : command->get_options()) {
      if (known->get_lnames().empty()) continue;
      const std::string candidate = "--" + known->get_lnames().front();
      if (const std::size_t d = edit_distance(name, candidate); d < distance) {
        distance = d;
        nearest = candidate;
      }
    }
  }
  const std::string mend = nearest.empty() ? "" : fmt::format(" (did you mean {}?)", nearest);
  return bad(fmt::format("there is no option '{}' here{}; see {}", name, mend, help_command(parser)));
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
  const CLI::App& command = parser.info->parsed() ? *parser.info : *parser.check;
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

/// `--limit=` with nothing after it: CLI11 would take the next word as the value, and it may be a file.
Result<void> refuse_empty_values(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word(argv[i]);
    if (word == "--") break;
    if (word.starts_with("--") && word.ends_with('=') && word.find('=') == word.size() - 1)
      return bad(fmt::format("'{}' has no value after the '='", word));
  }
  return {};
}

Result<void> take_scales(const std::vector<std::string>& raw, CheckArguments& to) {
  for (const std::string& text : raw) {
    const std::size_t at = text.rfind('=');
    if (at == std::string::npos)
      return bad(fmt::format("--scale takes FILE=S, such as plate.stl=25.4, not '{}'", text));
    const std::string file = text.substr(0, at);
    const auto factor = parse_positive(std::string_view(text).substr(at + 1));
    if (!factor)
      return bad(fmt::format("--scale {}: '{}' is not a positive number such as 25.4", text, text.substr(at + 1)));
    if (std::find(to.files.begin(), to.files.end(), file) == to.files.end())
      return bad(
          fmt::format("--scale {}: '{}' is none of the files to read; write it as it stands among them", text, file));
    for (const auto& [other, _] : to.scales)
      if (other == file) return bad(fmt::format("--scale is given twice for '{}'", file));
    to.scales.emplace_back(file, *factor);
  }
  return {};
}

Result<void> take_max_file(const std::string& text, std::uint64_t& to) {
  if (text.empty()) return {};
  const auto bytes = parse_bytes(text);
  if (!bytes) return bad(fmt::format("--max-file takes a number of bytes such as 500M or 2G, not '{}'", text));
  to = *bytes;
  return {};
}

Result<Command> finish_check(Raw& raw) {
  CheckArguments& to = raw.check;
  if (!raw.json.empty()) to.json = raw.json;
  if (!raw.limit.empty()) {
    const auto limit = parse_whole(raw.limit);
    if (!limit) return bad(fmt::format("--limit takes a whole number from 0 up, not '{}'", raw.limit));
    to.limit = *limit;
  }
  if (!raw.threads.empty()) {
    const auto threads = parse_whole(raw.threads);
    if (!threads || *threads > 1024)
      return bad(fmt::format("--threads takes a whole number from 0 to 1024, not '{}'", raw.threads));
    to.threads = static_cast<int>(*threads);
  }
  constexpr std::string_view kBackends[] = {"auto", "simd", "scalar", "gpu", "raster", "hybrid"};
  if (std::find(std::begin(kBackends), std::end(kBackends), to.backend) == std::end(kBackends))
    return bad(fmt::format("--backend is auto, simd, scalar, gpu, raster or hybrid, not '{}'", to.backend));
  if (!raw.device_share.empty()) {
    const char* const end = raw.device_share.data() + raw.device_share.size();
    const auto [stop, error] = std::from_chars(raw.device_share.data(), end, to.device_share);
    if (error != std::errc() || stop != end || !(to.device_share >= 0 && to.device_share <= 1))
      return bad(fmt::format("--device-share takes a number from 0 to 1, not '{}'", raw.device_share));
    if (to.backend != "hybrid") return bad("--device-share is for --backend hybrid");
  }
  for (std::size_t i = 0; i + 1 < raw.ignored.size(); i += 2)
    to.ignored.emplace_back(raw.ignored[i], raw.ignored[i + 1]);
  if (auto taken = take_scales(raw.scales, to); !taken) return taken.error();
  if (auto taken = take_max_file(raw.max_file, to.max_file_bytes); !taken) return taken.error();
  return Command(std::move(to));
}

Result<Command> finish_info(Raw& raw) {
  if (!raw.json.empty()) raw.info.json = raw.json;
  if (auto taken = take_max_file(raw.max_file, raw.info.max_file_bytes); !taken) return taken.error();
  return Command(std::move(raw.info));
}

}  // namespace

Result<Command> parse_command_line(int argc, const char* const* argv) {
  Raw raw;
  Parser parser;
  parser.app.set_help_flag("--help,-h", "this page");
  parser.app.set_version_flag("--version", "impinge " IMPINGE_VERSION);
  parser.app.allow_extras();
  parser.check = parser.app.add_subcommand("check")->allow_extras();
  parser.info = parser.app.add_subcommand("info")->allow_extras();
  parser.devices = parser.app.add_subcommand("devices")->allow_extras();
  parser.devices->set_help_flag("--help,-h", "this page");
  add_check(*parser.check, raw);
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
    return bad("no file to read is named; see " + help_command(parser));
  } catch (const CLI::RequiresError&) {
    // The only thing that requires another is --triangles.
    return bad("--triangles goes into the JSON: name its file with --json FILE");
  } catch (const CLI::ParseError& error) {
    return bad(fmt::format("{}; see {}", in_plain_words(parser, error), help_command(parser)));
  }
  if (const auto extra = extras(parser); !extra.empty()) return unexpected(parser, extra.front());
  if (parser.check->parsed() + parser.info->parsed() + parser.devices->parsed() > 1)
    return bad("check, info and devices cannot be asked for at once");
  if (parser.check->parsed()) return finish_check(raw);
  if (parser.info->parsed()) return finish_info(raw);
  if (parser.devices->parsed()) return Command(DevicesArguments{});
  return bad("no command is given; impinge check FILE... finds what touches, impinge --help tells more");
}

}  // namespace impinge::cli
