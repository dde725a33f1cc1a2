// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>

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

}  // namespace impinge::cli
