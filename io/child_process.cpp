// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

namespace impinge::io {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kTick{50};
constexpr std::size_t kMostSaid = 4096;

/// A pipe whose ends close with it and are never inherited by chance.
class Pipe {
 public:
  Pipe() { is_open_ = pipe2(ends_.data(), O_CLOEXEC) == 0; }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  [[nodiscard]] bool is_open() const { return is_open_; }
  [[nodiscard]] int read_end() const { return ends_[0]; }
  [[nodiscard]] int write_end() const { return ends_[1]; }
  void close_write_end() { close_end(1); }
  void close_read_end() { close_end(0); }

 private:
  void close_end(std::size_t i) {
    if (ends_[i] >= 0) close(ends_[i]);
    ends_[i] = -1;
  }
  std::array<int, 2> ends_{-1, -1};
  bool is_open_ = false;
};

/// 0, or the reason as an errno.
int spawn(pid_t& child, const std::vector<std::string>& arguments, int out, int err) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  if (const int code = posix_spawn_file_actions_init(&files)) return code;
  if (const int code = posix_spawnattr_init(&attributes)) {
    posix_spawn_file_actions_destroy(&files);
    return code;
  }
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  int code = posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  if (code == 0) code = posix_spawn_file_actions_adddup2(&files, out, 1);
  if (code == 0) code = posix_spawn_file_actions_adddup2(&files, err, 2);
  if (code == 0) code = posix_spawn_file_actions_addclosefrom_np(&files, 3);
  if (code == 0) code = posix_spawnattr_setsigmask(&attributes, &none);
  if (code == 0) code = posix_spawnattr_setsigdefault(&attributes, &all);
  if (code == 0) code = posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  if (code == 0) code = posix_spawn(&child, argv[0], &files, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return code;
}

/// Reads what is there; false at the end of the pipe.
bool drain(int descriptor, std::string& into, std::size_t most) {
  std::array<char, 1 << 16> buffer;
  const ssize_t count = read(descriptor, buffer.data(), buffer.size());
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  into.append(buffer.data(),
              std::min<std::size_t>(static_cast<std::size_t>(count), most - std::min(most, into.size())));
  return count > 0;
}

/// Whether a limit is reached; says which in the report.
bool is_over(ChildReport& report, const ChildLimits& limits, Clock::time_point start) {
  report.cancelled = limits.stop.stop_requested();
  report.timed_out = Clock::now() - start >= limits.time;
  report.too_much = report.output.size() > limits.output_bytes;
  return report.cancelled || report.timed_out || report.too_much;
}

/// Collects both pipes until the child has closed them or a limit is reached.
void collect(ChildReport& report, const ChildLimits& limits, Clock::time_point start, Pipe& out, Pipe& err) {
  std::array<pollfd, 2> pipes{{{out.read_end(), POLLIN, 0}, {err.read_end(), POLLIN, 0}}};
  while ((pipes[0].fd >= 0 || pipes[1].fd >= 0) && !is_over(report, limits, start)) {
    if (poll(pipes.data(), pipes.size(), static_cast<int>(kTick.count())) <= 0) continue;
    // One byte past the limit shows that it is passed.
    if (pipes[0].revents != 0 && !drain(pipes[0].fd, report.output, limits.output_bytes + 1)) pipes[0].fd = -1;
    if (pipes[1].revents != 0 && !drain(pipes[1].fd, report.said, kMostSaid)) pipes[1].fd = -1;
  }
}

void reap(ChildReport& report, const ChildLimits& limits, Clock::time_point start, pid_t child) {
  for (;;) {
    const pid_t ended = waitpid(child, &report.status, WNOHANG);
    if (ended == child) return;
    if (ended < 0 && errno != EINTR) {  // the program's owner reaps or ignores children itself
      report.failure = std::strerror(errno);
      return;
    }
    if (is_over(report, limits, start)) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  kill(child, SIGKILL);
  while (waitpid(child, &report.status, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

ChildReport run_child(const std::vector<std::string>& arguments, const ChildLimits& limits) {
  ChildReport report;
  Pipe out, err;
  pid_t child = 0;
  const auto start = Clock::now();
  if (!out.is_open() || !err.is_open()) {
    report.failure = std::strerror(errno);
    return report;
  }
  if (const int code = spawn(child, arguments, out.write_end(), err.write_end())) {
    report.failure = std::strerror(code);
    return report;
  }
  out.close_write_end();
  err.close_write_end();
  collect(report, limits, start, out, err);
  out.close_read_end();  // a child that goes on writing is told so by SIGPIPE
  err.close_read_end();
  reap(report, limits, start, child);
  return report;
}

}  // namespace impinge::io
