// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "progress.hpp"
#include "report/text.hpp"

namespace impinge::cli {
using namespace report;

void Pace::note(double seconds, const Work& work) {
  if (!(work.total > 0) || work.total != work_.total || work.done < work_.done) *this = {};
  if (!(work.total > 0)) return;
  if (samples_.empty()) start_ = now_ = seconds, first_done_ = work.done;
  const double passed = seconds - now_;
  now_ = seconds, work_ = work;
  // About 200 samples are enough, however long the work takes.
  if (samples_.empty() || now_ - samples_.back().seconds >= (now_ - start_) / 200)
    samples_.push_back({now_, work.done});
  while (samples_.size() > 1 && samples_[1].seconds <= start_ + (now_ - start_) / 2) samples_.pop_front();

  const std::optional<double> speed = rate();
  if (!speed) return left_.reset();
  // While the work is all but at a standstill, the speed of the newer half would give far too long a time.
  constexpr double kSlowest = 4;  // The assumed speed is at least a fourth of the average.
  const double average = (work.done - first_done_) / (now_ - start_);
  const double expected = std::max(work.total - work.done, 0.0) / std::max(*speed, average / kSlowest);
  constexpr double kFollows = 3;  // seconds
  const double counted = left_ ? std::max(*left_ - passed, 0.0) : expected;
  left_ = counted + (expected - counted) * (1 - std::exp(-passed / kFollows));
}

std::optional<double> Pace::rate() const {
  constexpr double kSoonest = 3;  // seconds
  if (samples_.empty() || now_ - start_ < kSoonest) return std::nullopt;
  const double done = work_.done - samples_.front().done, seconds = now_ - samples_.front().seconds;
  if (!(done > 0) || !(seconds > 0)) return std::nullopt;
  return done / seconds;
}

std::optional<double> Pace::seconds_left() const { return left_; }

std::string rate_text(double rate, std::string_view unit) {
  constexpr double kMost = 1e15;
  if (rate >= 10) return fmt::format("{} {}/s", grouped(static_cast<std::uint64_t>(std::min(rate, kMost))), unit);
  return fmt::format("{:.{}f} {}/s", rate, rate < 1 ? 2 : 1, unit);
}

std::string left_text(double seconds) {
  constexpr double kMost = 1e9;
  const double whole = std::ceil(std::clamp(seconds, 0.0, kMost));
  if (whole < 100) return fmt::format("{:.0f} s left", whole);
  const double minutes = std::ceil(whole / 60);
  if (minutes < 100) return fmt::format("{:.0f} min left", minutes);
  return fmt::format("{:.0f} h left", std::ceil(minutes / 60));
}

}  // namespace impinge::cli
