// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

namespace impinge::io {

struct ChildLimits {
  std::chrono::seconds time;   ///< wall clock
  std::uint64_t output_bytes;  ///< of what it writes on standard output
  std::stop_token stop{};
};

struct ChildReport {
  std::string failure;  ///< not empty: the child never ran, and why
  bool cancelled = false, timed_out = false, too_much = false;
  int status = 0;      ///< as waitpid gives it
  std::string output;  ///< standard output
  std::string said;    ///< the beginning of standard error
};

/// Runs a program to its end, or kills it at a limit or on request; it has always been reaped on return.
/// Its standard input is empty, it inherits no other descriptor and no blocked or ignored signal.
ChildReport run_child(const std::vector<std::string>& arguments, const ChildLimits& limits);

}  // namespace impinge::io
