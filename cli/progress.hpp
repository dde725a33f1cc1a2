// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

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

  /// What is being done now (a printable text), and how much of it is done, 0 to 1; negative: nobody knows.
  /// `fraction` is called from another thread until the next phase or `end`.
  void phase(std::string label, std::function<double()> fraction);
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
  std::function<double()> fraction_;
  bool drawn_ = false;
  std::jthread painter_;
};

/// The line itself, at most `width` columns: "checking  [#####.....]  50 %  12.3 s".
std::string progress_text(const std::string& label, double fraction, double elapsed_seconds, std::size_t width);

}  // namespace impinge::cli
