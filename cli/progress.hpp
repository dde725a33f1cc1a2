// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "pace.hpp"

namespace impinge::cli {

/// A line that shows how far long work has come. It is drawn only on a terminal, first when the work has taken half a
/// second, and wiped away at the end, so that short runs, pipes and logs never see it.
class ProgressLine {
 public:
  /// `wanted` false: never drawn.
  ProgressLine(int descriptor, bool wanted);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Begins a phase: its label (a printable text), how much of the work is done, and the unit in which that is counted.
  /// `work` is called from another thread until the next phase or `end`. Successive phases with one unit share a speed
  /// estimate.
  void phase(
      std::string label, std::function<Work()> work = [] { return Work(); }, std::string unit = {});
  /// Wipes the line; nothing is drawn after that.
  void end();

 private:
  void draw();
  void wipe();

  int descriptor_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::string label_;
  std::function<Work()> work_;
  std::string unit_;
  Pace pace_;
  bool drawn_ = false;
  std::jthread painter_;
};

/// The line itself, at most `width` columns: "checking  [#####.....]  50 %  12.3 s  80 pairs/s, 13 s left". Where that
/// is too wide, the rate is left out first, then the time that is left; either may be empty. `fraction` is 0 to 1, or
/// negative if it is unknown.
std::string progress_text(const std::string& label, double fraction, double elapsed_seconds, std::size_t width,
                          const std::string& rate = {}, const std::string& left = {});

}  // namespace impinge::cli
