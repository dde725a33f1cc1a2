// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace impinge::cli {

/// How much work is done, and how much there is in all, in any unit; a total of 0 is unknown.
struct Work {
  double done = 0, total = 0;
};

/// Estimates the speed of long work and the time that it will still take. Both come from the newer half of the time so
/// far, since work is rarely even.
class Pace {
 public:
  /// Records the state of the work after so many seconds, which never decrease. Another total, or less done than
  /// before, is taken for other work, and the estimate starts anew.
  void note(double seconds, const Work& work);
  /// Units of work per second; nothing in the first three seconds, or while no work was done.
  [[nodiscard]] std::optional<double> rate() const;
  /// The seconds that the work will still take, at least 0. The value counts down evenly and approaches new estimates
  /// slowly, so that it does not jump about.
  [[nodiscard]] std::optional<double> seconds_left() const;

 private:
  struct Sample {
    double seconds, done;
  };
  double start_ = 0, now_ = 0, first_done_ = 0;
  Work work_;
  std::deque<Sample> samples_;  ///< those of the newer half, and the last one before it
  std::optional<double> left_;
};

/// "1,234 steps/s".
std::string rate_text(double rate, std::string_view unit);
/// "12 s left", rounded up.
std::string left_text(double seconds);

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
