// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace impinge::cli {

/// How much is done and to be done, in any unit; without a `total` above 0 nobody knows.
struct Work {
  double done = 0, total = 0;
};

/// How fast work goes on, and how long it will take: from its newer half, because work rarely goes evenly.
class Pace {
 public:
  /// Where the work stands; `seconds` never goes back. Other work, with another total or less done, starts anew.
  void note(double seconds, const Work& work);
  /// Of work in a second. Nothing in the first seconds, or where nothing has gone on.
  [[nodiscard]] std::optional<double> rate() const;
  /// Counts down evenly and follows what is expected only slowly; 0 or more.
  [[nodiscard]] std::optional<double> seconds_left() const;

 private:
  struct Sample {
    double seconds, done;
  };
  double start_ = 0, now_ = 0, first_done_ = 0;
  Work work_;
  std::deque<Sample> samples_;  ///< the first is the last one before the newer half
  std::optional<double> left_;
};

/// "1,234 steps/s".
std::string rate_text(double rate, std::string_view unit);
/// "12 s left", rounded up.
std::string left_text(double seconds);

}  // namespace impinge::cli
