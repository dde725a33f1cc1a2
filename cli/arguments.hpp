// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>

#include "impinge/report.hpp"
#include "impinge/result.hpp"
#include "report/motion/impacts_report.hpp"

/// The command line as values. See docs/cli.md for what each means.
namespace impinge::cli {
using namespace report;

/// What commands that answer are told of their output.
struct OutputArguments {
  std::optional<std::string> json;  ///< "-" is standard output
  bool quiet = false;
  bool force = false;  ///< replace files whatever their names end in
};

struct CheckArguments : SceneOptions, OutputArguments {
  bool triangles = false;
  bool first = false;
  bool self = false;
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
  std::string backend = "auto";
  std::string device;
  double device_share = -1;  ///< below 0: as the library sees fit
  bool stats = false;
};

struct ClashArguments : ReportOptions, OutputArguments {
  std::optional<std::string> html, csv, matrix, bcf, gltf;          ///< "-" is standard output
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();  ///< rows of the table
};

struct ViewArguments : SceneOptions, PageOptions, OutputArguments {
  std::optional<std::string> html;
};

struct MotionArguments : report::TimelineOptions, OutputArguments {
  std::optional<std::string> html;
};

struct ImpactsArguments : ImpactOptions, OutputArguments {
  std::optional<std::string> csv;  ///< "-" is standard output
};

struct InfoArguments : SceneOptions, OutputArguments {};

struct DevicesArguments {};

/// A text to print on standard output: the help or the version.
struct Notice {
  std::string text;
};

using Command = std::variant<CheckArguments, ClashArguments, ViewArguments, MotionArguments, ImpactsArguments,
                             InfoArguments, DevicesArguments, Notice>;

/// Errors: `bad_option`, with a sentence.
Result<Command> parse_command_line(int argc, const char* const* argv);

}  // namespace impinge::cli
