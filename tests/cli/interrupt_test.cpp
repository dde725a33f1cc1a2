// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Ctrl-C, and the progress line that makes people wait for it.
#include <poll.h>
#include <pty.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "meshes.hpp"
#include "program.hpp"

namespace impinge::test {
namespace {

using namespace std::chrono_literals;

/// Two fans with 64 million touching pairs, all for exact arithmetic: many seconds of work.
void write_long_work(const Folder& folder) {
  folder.write("p.off", off_fan(8000, 0));
  folder.write("q.off", off_fan(8000, 0.5));
}

class Interruption : public testing::TestWithParam<int> {};

void expect_clean_end(const Words& arguments, int signal) {
  const Folder folder;
  write_long_work(folder);
  const std::string old = R"({"version":1,"objects":[],"pairs":[]})";
  folder.write("out.json", old);
  const std::vector<std::string> before = folder.names();
  Words words{IMPINGE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  Running running(folder, words);
  ASSERT_TRUE(running.handles(signal, 20s));
  std::this_thread::sleep_for(300ms);
  const auto start = std::chrono::steady_clock::now();
  running.send(signal);
  const Ended run = running.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - start, 10s);
  EXPECT_EQ(run.signal, 0);
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err, "impinge: interrupted; there is no result\n");
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(folder.names(), before);
  EXPECT_EQ(folder.read("out.json"), old);
}

TEST_P(Interruption, EndsCleanlyWithoutHalfADocument) {
  expect_clean_end({"check", "p.off", "q.off", "--json", "out.json", "--triangles"}, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Interrupt, Interruption, testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST(Interrupt, EndsAClashCleanlyToo) {
  expect_clean_end({"clash", "p.off", "q.off", "--json", "out.json", "--regions"}, SIGINT);
}

struct Drawn {
  const char* command;
  const char* label;
};

class DrawnProgress : public testing::TestWithParam<Drawn> {};

TEST_P(DrawnProgress, IsSeenOnATerminalAndWiped) {
  const auto& [command, label] = GetParam();
  const Folder folder;
  write_long_work(folder);
  int screen = -1, terminal = -1;
  winsize size{};
  size.ws_row = 24;
  size.ws_col = 60;
  ASSERT_EQ(::openpty(&screen, &terminal, nullptr, nullptr, &size), 0);
  Launch launch;
  launch.err = terminal;
  launch.environment["TERM"] = "xterm";
  Running running(folder, {IMPINGE_PROGRAM, command, "p.off", "q.off"}, launch);
  ASSERT_TRUE(running.handles(SIGINT, 20s));
  std::string seen;
  const auto read_until = [&](const std::string& text) {
    const auto last = std::chrono::steady_clock::now() + 30s;
    while (seen.find(text) == std::string::npos && std::chrono::steady_clock::now() < last) {
      pollfd ready{screen, POLLIN, 0};
      if (::poll(&ready, 1, 20) <= 0) continue;
      char buffer[4096];
      const ssize_t got = ::read(screen, buffer, sizeof buffer);
      if (got > 0) seen.append(buffer, static_cast<std::size_t>(got));
    }
  };
  read_until(label);
  running.send(SIGINT);
  read_until("no result\r\n");
  const Ended run = running.wait();
  ::close(terminal);
  ::close(screen);
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(seen, HasSubstr(label));
  EXPECT_EQ(seen.rfind("\r\x1b[Kimpinge: interrupted"), seen.rfind("\r\x1b[K")) << seen;
}

INSTANTIATE_TEST_SUITE_P(Interrupt, DrawnProgress,
                         testing::Values(Drawn{"check", "checking 2 objects"}, Drawn{"clash", "judging 2 parts"}),
                         [](const auto& test) { return test.param.command; });

}  // namespace
}  // namespace impinge::test
