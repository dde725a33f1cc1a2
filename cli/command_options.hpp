// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"

/// What each command takes, as CLI11 is told.
namespace impinge::cli {

/// What CLI11 fills in: numbers stay texts, so that this program says what is wrong with them.
struct Raw {
  CheckArguments check;
  ClashArguments clash;
  ViewArguments view;
  MotionArguments motion;
  InfoArguments info;
  std::string frames, animation;
  std::string json, html, csv, bcf, gltf, unit, up, date, topics, page_triangles, config, previous, group_by, limit,
      threads, max_file, device_share, tolerance, clearance;
  std::vector<std::string> ignored, scales, fail_on;
};

/// What is wrong with the command line, as a sentence.
inline Error bad_option(std::string sentence) { return {Code::bad_option, std::move(sentence)}; }

/// Declare a command's options, which write into `raw` as the command line is parsed.
void add_check(CLI::App& command, Raw& raw);
void add_clash(CLI::App& command, Raw& raw);
void add_motion(CLI::App& command, Raw& raw);
void add_view(CLI::App& command, Raw& raw);
void add_info(CLI::App& command, Raw& raw);

}  // namespace impinge::cli
