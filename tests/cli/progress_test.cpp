// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <utility>

#include "text.hpp"

namespace impinge::cli {
namespace {

using namespace std::chrono_literals;

TEST(Progress, TextFitsAnyWidth) {
  EXPECT_EQ(progress_text("checking", 0.5, 12.34, 80), "checking  [##########..........]  50 %  12.3 s");
  EXPECT_EQ(progress_text("checking", 1.5, 0, 80), "checking  [####################] 100 %  0.0 s");
  EXPECT_EQ(progress_text("checking", 0.9999, 0, 80), "checking  [###################.]  99 %  0.0 s");
  EXPECT_EQ(progress_text("reading", -1, 2, 80), "reading  2.0 s");
  for (std::size_t width = 0; width < 90; ++width) {
    EXPECT_LE(columns(progress_text("reading \xe9\x83\xa8\xe5\x93\x81.off (1 of 2)", 0.3, 4, width)), width);
    EXPECT_LE(columns(progress_text("reading \xe9\x83\xa8\xe5\x93\x81.off (1 of 2)", -1, 4, width)), width);
  }
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
    line.phase("working", [&] { return drawn++, 0.25; });
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
    line.phase("working", [] { return 0.25; });
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
    line.phase("working", [] { return 0.25; });
    std::this_thread::sleep_for(700ms);
  }
  EXPECT_EQ(read_until(ends[0], {}, 50ms), "");
  ::close(ends[0]);
  ::close(ends[1]);
}

}  // namespace
}  // namespace impinge::cli
