// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include "report/sink.hpp"
#include "report/text.hpp"
#include "terminal.hpp"

namespace impinge::cli {
using namespace report;
namespace {

using namespace std::chrono_literals;
constexpr auto kQuiet = 500ms, kBetween = 100ms;

bool can_be_redrawn(int descriptor) {
  const char* terminal = std::getenv("TERM");
  return ::isatty(descriptor) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

void put(int descriptor, std::string_view text) {
  Sink sink(descriptor, "the terminal");
  sink.write(text);
  // A progress line that cannot be shown is no reason to end the work.
  if (!sink.flush()) return;
}

}  // namespace

ProgressLine::ProgressLine(int descriptor, bool wanted) : descriptor_(descriptor) {
  if (!wanted || !can_be_redrawn(descriptor)) return;
  painter_ = std::jthread([this](const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    const auto asked = [&] { return stop.stop_requested(); };
    if (changed_.wait_for(lock, stop, kQuiet, asked)) return;
    do {
      draw();
    } while (!changed_.wait_for(lock, stop, kBetween, asked) && !asked());
  });
}

ProgressLine::~ProgressLine() { end(); }

void ProgressLine::phase(std::string label, std::function<Work()> work, std::string unit) {
  const std::scoped_lock lock(mutex_);
  label_ = std::move(label);
  work_ = std::move(work);
  if (unit != unit_) pace_ = {};
  unit_ = std::move(unit);
}

void ProgressLine::end() {
  if (!painter_.joinable()) return;
  painter_.request_stop();
  painter_.join();
  wipe();
  work_ = nullptr;
}

void ProgressLine::draw() {
  if (!work_) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  // The last column stays free, since some terminals wrap when it is written.
  const std::size_t width = width_of(descriptor_).value_or(80) - 1;
  const Work work = work_();
  pace_.note(elapsed.count(), work);
  const std::optional<double> rate = pace_.rate(), left = pace_.seconds_left();
  put(descriptor_, "\r" +
                       progress_text(label_, work.total > 0 ? work.done / work.total : -1, elapsed.count(), width,
                                     rate ? rate_text(*rate, unit_) : "", left ? left_text(*left) : "") +
                       "\x1b[K");
  drawn_ = true;
}

void ProgressLine::wipe() {
  if (drawn_) put(descriptor_, "\r\x1b[K");
  drawn_ = false;
}

std::string progress_text(const std::string& label, double fraction, double elapsed_seconds, std::size_t width,
                          const std::string& rate, const std::string& left) {
  const std::string time = fmt::format("{:.1f} s", elapsed_seconds);
  if (!(fraction >= 0)) return fit(fmt::format("{}  {}", label, time), width);
  const double part = std::min(fraction, 1.0);
  // The percentage is rounded down, so that 100 % means all.
  const auto percent = static_cast<int>(part * 100);
  const auto bar_of = [&](std::size_t length, const std::string& after) {
    const auto filled = static_cast<std::size_t>(part * static_cast<double>(length));
    return fmt::format("  [{}{}] {:3} %  {}{}{}", std::string(filled, '#'), std::string(length - filled, '.'), percent,
                       time, after.empty() ? "" : "  ", after);
  };
  constexpr std::size_t kBar = 20;
  const std::string both = rate.empty() || left.empty() ? rate + left : fmt::format("{}, {}", rate, left);
  for (const auto& [length, after] : {std::pair(kBar, both), std::pair(kBar / 2, both), std::pair(kBar, left)})
    if (const std::string bar = bar_of(length, after); columns(label) + columns(bar) <= width) return label + bar;
  const std::string bar = bar_of(kBar, "");
  constexpr std::size_t kShortestLabel = 10;
  if (columns(bar) + kShortestLabel > width) return fit(fmt::format("{} {} %", label, percent), width);
  return fit(label, width - columns(bar)) + bar;
}

}  // namespace impinge::cli
