// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "impinge/result.hpp"

namespace impinge::cli {}
namespace impinge::report {
using namespace cli;  // until reports have options of their own
}  // namespace impinge::report

/// The command line as values. See docs/cli.md for what each means.
namespace impinge::cli {
using namespace report;

/// What `check` and `clash` are both told.
struct SceneArguments {
  std::vector<std::string> files;
  std::optional<std::string> json;  ///< "-" is standard output
  int threads = 0;
  std::vector<std::pair<std::string, std::string>> ignored;
  std::vector<std::pair<std::string, double>> scales;  ///< each file at most once, of `files` or the configuration
  std::uint64_t max_file_bytes = 2'000'000'000;
  bool quiet = false;
  bool force = false;  ///< replace files whatever their names end in
};

struct CheckArguments : SceneArguments {
  bool triangles = false;
  bool first = false;
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
  std::string backend = "auto";
  std::string device;
  double device_share = -1;  ///< below 0: as the library sees fit
  bool stats = false;
};

/// What makes `clash` end with exit code 1.
struct FailOn {
  bool contact = false;      ///< whatever is not apart
  bool penetration = false;  ///< duplicate, penetrating and crossing
  bool inside = false;
  bool clearance = false;  ///< apart, and nearer than the clearance
  bool fresh = false;      ///< and of all these only what is new since the previous run
};

/// How the table puts pairs together.
enum class GroupBy : std::uint8_t { none, part, type, test };

/// What a page is made of.
struct PageArguments {
  std::optional<std::string> html;
  std::uint64_t page_triangles = 1'000'000;  ///< about so many are drawn at most
  std::optional<bool> y_up;                  ///< or Z, for other outputs too; nothing: by the files' formats
};

/// Files for other tools, and what these take lengths and dates for.
struct ExportArguments {
  std::optional<std::string> csv, bcf, gltf;  ///< "-" is standard output
  std::optional<double> metres;               ///< that a unit of the files' coordinates has; nothing: nobody said
  std::string date;                           ///< of the BCF's topics, "2024-05-31T16:30:00Z"
  std::uint64_t topics = 1'000;               ///< of the BCF, at most
};

struct ClashArguments : SceneArguments, PageArguments, ExportArguments {
  std::optional<double> tolerance;  ///< nothing: auto
  double clearance = 0;
  bool depth = false;
  bool regions = false;
  FailOn fail_on{.penetration = true, .inside = true};
  bool within_products = false;
  std::optional<std::string> config, previous, decisions;  ///< files
  GroupBy group_by = GroupBy::none;
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();  ///< rows of the table
};

struct ViewArguments : SceneArguments, PageArguments {};

struct MotionArguments : SceneArguments, PageArguments {
  std::uint32_t frames = 120;            ///< steps
  std::optional<std::string> animation;  ///< its name or number; nothing: the first
  std::optional<double> tolerance;       ///< nothing: auto
  bool depth = false;
  FailOn fail_on{.penetration = true, .inside = true};
};

struct InfoArguments {
  std::vector<std::string> files;
  std::optional<std::string> json;
  std::uint64_t max_file_bytes = 2'000'000'000;
  bool force = false;
};

struct DevicesArguments {};

/// A text to print on standard output: the help or the version.
struct Notice {
  std::string text;
};

using Command = std::variant<CheckArguments, ClashArguments, ViewArguments, MotionArguments, InfoArguments,
                             DevicesArguments, Notice>;

/// Errors: `bad_option`, with a sentence.
Result<Command> parse_command_line(int argc, const char* const* argv);

}  // namespace impinge::cli
