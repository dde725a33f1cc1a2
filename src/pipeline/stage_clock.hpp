// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace impinge {

/// Adds the time since it was last asked to a counter; one that does not run adds nothing.
class StageClock {
 public:
  explicit StageClock(bool runs = true) : runs_(runs), last_(now()) {}

  void charge(double& seconds) {
    if (!runs_) return;
    const auto time = now();
    seconds += std::chrono::duration<double>(time - last_).count();
    last_ = time;
  }

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] Clock::time_point now() const { return runs_ ? Clock::now() : Clock::time_point(); }

  bool runs_;
  Clock::time_point last_;
};

}  // namespace impinge
