// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "arguments.hpp"
#include "report/motion/motion_report.hpp"
#include "report/sink.hpp"

namespace impinge::cli {

/// Prints the table of clashes by the time at which they begin, and a summary that names the length of a step.
void print_motion(const MotionReport& report, const MotionArguments& arguments, Sink& sink,
                  std::optional<std::size_t> width, const std::stop_token& stop);

}  // namespace impinge::cli
