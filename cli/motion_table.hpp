// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "report/motion/motion_report.hpp"

namespace impinge::cli {

/// What a person reads: when which parts clash, in the order of the times, and how far to trust it.
void print_motion(const MotionReport& report, const MotionArguments& arguments, Sink& sink,
                  std::optional<std::size_t> width, const std::stop_token& stop);

}  // namespace impinge::cli
