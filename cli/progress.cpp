// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "sink.hpp"
#include "text.hpp"

namespace impinge::cli {
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

void ProgressLine::phase(std::string label, std::function<double()> fraction) {
  const std::scoped_lock lock(mutex_);
  label_ = std::move(label);
  fraction_ = std::move(fraction);
}

void ProgressLine::end() {
  if (!painter_.joinable()) return;
  painter_.request_stop();
  painter_.join();
  wipe();
  fraction_ = nullptr;
}

void ProgressLine::draw() {
  if (!fraction_) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  // One column stays free: some terminals wrap when the last one is written.
  const std::size_t width = width_of(descriptor_).value_or(80) - 1;
  put(descriptor_, "\r" + progress_text(label_, fraction_(), elapsed.count(), width) + "\x1b[K");
  drawn_ = true;
}

void ProgressLine::wipe() {
  if (drawn_) put(descriptor_, "\r\x1b[K");
  drawn_ = false;
}

std::string progress_text(const std::string& label, double fraction, double elapsed_seconds, std::size_t width) {
  const std::string time = fmt::format("{:.1f} s", elapsed_seconds);
  if (!(fraction >= 0)) return fit(fmt::format("{}  {}", label, time), width);
  constexpr std::size_t kBar = 20;
  const double part = std::min(fraction, 1.0);
  // Rounded down: 100 % is said only when it is so.
  const auto filled = static_cast<std::size_t>(part * kBar);
  const auto percent = static_cast<int>(part * 100);
  const std::string bar =
      fmt::format("  [{}{}] {:3} %  {}", std::string(filled, '#'), std::string(kBar - filled, '.'), percent, time);
  constexpr std::size_t kShortestLabel = 10;
  if (columns(bar) + kShortestLabel > width) return fit(fmt::format("{} {} %", label, percent), width);
  return fit(label, width - columns(bar)) + bar;
}

}  // namespace impinge::cli
