// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "report/text.hpp"

namespace impinge::cli {
namespace {

using namespace std::chrono_literals;

TEST(Progress, TextFitsAnyWidth) {
  EXPECT_EQ(progress_text("checking", 0.5, 12.34, 80), "checking  [##########..........]  50 %  12.3 s");
  EXPECT_EQ(progress_text("checking", 1.5, 0, 80), "checking  [####################] 100 %  0.0 s");
  EXPECT_EQ(progress_text("checking", 0.9999, 0, 80), "checking  [###################.]  99 %  0.0 s");
  EXPECT_EQ(progress_text("reading", -1, 2, 80), "reading  2.0 s");
  for (std::size_t width = 0; width < 90; ++width) {
    EXPECT_LE(report::columns(progress_text("reading \xe9\x83\xa8\xe5\x93\x81.off (1 of 2)", 0.3, 4, width)), width);
    EXPECT_LE(report::columns(progress_text("reading \xe9\x83\xa8\xe5\x93\x81.off (1 of 2)", -1, 4, width)), width);
  }
}

TEST(Progress, TextLosesTheRateFirstThenTheTimeLeft) {
  const auto text = [](std::size_t width) {
    return progress_text("checking", 0.5, 12.34, width, "80 pairs/s", "13 s left");
  };
  const std::string bar = "checking  [##########..........]  50 %  12.3 s",
                    shorter = "checking  [#####.....]  50 %  12.3 s";
  EXPECT_EQ(text(80), bar + "  80 pairs/s, 13 s left");
  EXPECT_EQ(text(60), shorter + "  80 pairs/s, 13 s left");
  EXPECT_EQ(text(58), bar + "  13 s left");
  EXPECT_EQ(text(56), bar);
  EXPECT_EQ(progress_text("checking", 0.5, 12.34, 80, "", "13 s left"), bar + "  13 s left");
  EXPECT_EQ(progress_text("checking", 0.5, 12.34, 80, "80 pairs/s", ""), bar + "  80 pairs/s");
  for (std::size_t width = 0; width < 90; ++width) EXPECT_LE(report::columns(text(width)), width);
}

TEST(Pace, IsThatOfEvenWorkAfterSomeSeconds) {
  Pace pace;
  for (int i = 0; i <= 900; ++i) {
    const double seconds = 100 + i / 10.0, done = 5.0 * i;  // 50 in a second
    pace.note(seconds, {done, 5000});
    ASSERT_EQ(pace.rate().has_value(), i >= 30) << i;
    ASSERT_EQ(pace.seconds_left().has_value(), i >= 30) << i;
    if (i < 30) continue;
    EXPECT_NEAR(*pace.rate(), 50, 1e-9);
    EXPECT_NEAR(*pace.seconds_left(), (5000 - done) / 50, 1e-6);
  }
}

TEST(Pace, IsNotThatOfAQuickBeginning) {
  // 400 of 1000 at once, the rest at 10 in a second.
  Pace pace;
  for (int i = 0; i <= 200; ++i) pace.note(i / 10.0, {i < 10 ? 40.0 * i : 400.0 + (i - 10), 1000});
  EXPECT_NEAR(*pace.rate(), 10, 0.5);
  EXPECT_NEAR(*pace.seconds_left(), 41, 6);
}

TEST(Pace, StaysSoberWhereWorkAllButStandsStill) {
  Pace pace;
  for (int i = 0; i <= 200; ++i) pace.note(i / 10.0, {i < 50 ? 10.0 * i : 500 + i / 200.0, 1000});
  EXPECT_LE(*pace.seconds_left(), 4 * 20);
  EXPECT_GE(*pace.seconds_left(), 20);
}

TEST(Pace, NeitherJumpsNorEndsBelowZero) {
  Pace pace;
  std::optional<double> last;
  std::uint64_t state = 1;
  double done = 0;
  for (int i = 0; i <= 3000; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    // Hardly anything, and now and then much at a time; more than there is at last.
    if (state >> 60 == 0) done += static_cast<double>(state >> 40 & 0xFF);
    pace.note(i / 10.0, {done, 20000});
    const std::optional<double> left = pace.seconds_left();
    if (left) {
      EXPECT_GE(*left, 0);
      EXPECT_TRUE(std::isfinite(*left));
    }
    if (left && last && i > 200) {
      EXPECT_NEAR(*left, *last, 0.1 + 0.1 * *last) << i;
    }
    last = left;
  }
}

TEST(Pace, StartsAnewWithOtherWorkAndSaysNothingOfNone) {
  Pace pace;
  for (int i = 0; i <= 50; ++i) pace.note(i / 10.0, {1.0 * i, 100});
  EXPECT_TRUE(pace.rate());
  pace.note(5.1, {0, 200});
  EXPECT_FALSE(pace.rate() || pace.seconds_left());
  for (int i = 0; i <= 100; ++i) pace.note(6 + i / 10.0, {0, 200});
  EXPECT_FALSE(pace.rate() || pace.seconds_left()) << "nothing has gone on";
  for (int i = 0; i <= 100; ++i) pace.note(20 + i / 10.0, {0, 0});
  EXPECT_FALSE(pace.rate() || pace.seconds_left()) << "nobody knows how much there is";
}

TEST(Pace, IsSaidInWords) {
  EXPECT_EQ(rate_text(1234567.8, "steps"), "1,234,567 steps/s");
  EXPECT_EQ(rate_text(3.25, "frames"), "3.2 frames/s");
  EXPECT_EQ(rate_text(0.051, "MB"), "0.05 MB/s");
  EXPECT_EQ(left_text(0), "0 s left");
  EXPECT_EQ(left_text(-1), "0 s left");
  EXPECT_EQ(left_text(11.2), "12 s left");
  EXPECT_EQ(left_text(99.5), "2 min left");
  EXPECT_EQ(left_text(5000), "84 min left");
  EXPECT_EQ(left_text(7201), "3 h left");
}

/// What can be read within the time; stops early once it ends with `end`. A terminal hands over its text some time
/// after it was written.
std::string read_until(int descriptor, std::string_view end, std::chrono::milliseconds patience) {
  std::string text;
  const auto last = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < last && (end.empty() || !text.ends_with(end))) {
    pollfd ready{descriptor, POLLIN, 0};
    if (::poll(&ready, 1, 20) <= 0 || (ready.revents & POLLIN) == 0) continue;
    char buffer[4096];
    const ssize_t got = ::read(descriptor, buffer, sizeof buffer);
    if (got > 0) text.append(buffer, static_cast<std::size_t>(got));
  }
  return text;
}

class Terminal : public testing::Test {
 protected:
  void SetUp() override {
    ::setenv("TERM", "xterm", 1);
    ASSERT_EQ(::openpty(&screen, &terminal, nullptr, nullptr, nullptr), 0);
  }
  void TearDown() override {
    ::close(screen);
    ::close(terminal);
  }
  int screen = -1, terminal = -1;
};

TEST_F(Terminal, SeesTheProgressLineAfterHalfASecondUntilItIsWiped) {
  std::atomic<int> drawn{0};
  const auto start = std::chrono::steady_clock::now();
  {
    ProgressLine line(terminal, true);
    line.phase("working", [&] { return drawn++, Work{1, 4}; });
    while (drawn < 2 && std::chrono::steady_clock::now() - start < 60s) std::this_thread::sleep_for(5ms);
    EXPECT_GE(std::chrono::steady_clock::now() - start, 500ms);
  }
  const std::string text = read_until(screen, {}, 500ms);
  EXPECT_NE(text.find("working  [#####"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("\r\x1b[K")) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST_F(Terminal, SeesNothingOfShortWorkOrWithoutBeingWanted) {
  for (const auto& [wanted, life] : {std::pair(true, 20ms), std::pair(false, 700ms)}) {
    ProgressLine line(terminal, wanted);
    line.phase("working", [] { return Work{1, 4}; });
    std::this_thread::sleep_for(life);
  }
  EXPECT_EQ(read_until(screen, {}, 200ms), "");
}

TEST(Progress, IsNeverDrawnInAPipe) {
  ::setenv("TERM", "xterm", 1);
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  {
    ProgressLine line(ends[1], true);
    line.phase("working", [] { return Work{1, 4}; });
    std::this_thread::sleep_for(700ms);
  }
  EXPECT_EQ(read_until(ends[0], {}, 50ms), "");
  ::close(ends[0]);
  ::close(ends[1]);
}

}  // namespace
}  // namespace impinge::cli
