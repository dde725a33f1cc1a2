// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace impinge::test {
namespace {

std::string contents(int descriptor) {
  std::string text;
  char buffer[1 << 14];
  ::lseek(descriptor, 0, SEEK_SET);
  for (ssize_t got = 0; (got = ::read(descriptor, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(got));
  return text;
}

[[noreturn]] void become(const Folder& folder, const Words& words, const Launch& launch, int out, int err) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
  ::unsetenv("COLUMNS");
  ::unsetenv("TERM");
  for (const auto& [name, value] : launch.environment) ::setenv(name.c_str(), value.c_str(), 1);
  const int in = ::open("/dev/null", O_RDONLY);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  if (launch.close_out) ::close(STDOUT_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  if (::chdir(folder.path().c_str()) == 0) ::execv(arguments[0], arguments.data());
  ::_exit(127);
}

}  // namespace

Running::Running(const Folder& folder, const Words& words, const Launch& launch)
    : out_(::memfd_create("out", MFD_CLOEXEC)), err_(::memfd_create("err", MFD_CLOEXEC)) {
  process_ = ::fork();
  if (process_ == 0)
    become(folder, words, launch, launch.out < 0 ? out_ : launch.out, launch.err < 0 ? err_ : launch.err);
}

Running::~Running() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    wait();
  }
  ::close(out_);
  ::close(err_);
}

bool Running::handles(int signal, std::chrono::seconds patience) const {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < end) {
    std::ifstream status("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:") && (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0)
        return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

void Running::send(int signal) const { ::kill(process_, signal); }

Ended Running::wait() {
  int status = 0;
  ::waitpid(process_, &status, 0);
  process_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, WIFSIGNALED(status) ? WTERMSIG(status) : 0, contents(out_),
          contents(err_)};
}

Words joined(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Ended impinge(const Folder& folder, const Words& arguments, const Launch& launch) {
  return Running(folder, joined({IMPINGE_PROGRAM}, arguments), launch).wait();
}

std::string sentence_of(const Ended& run) {
  EXPECT_EQ(run.code, 2) << run.err;
  EXPECT_EQ(run.signal, 0);
  EXPECT_THAT(run.err, StartsWith("impinge: "));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  return run.err;
}

std::string refusal(const Folder& folder, const Words& arguments, const Launch& launch) {
  const Ended run = impinge(folder, arguments, launch);
  EXPECT_EQ(run.out, "");
  return sentence_of(run);
}

json document(const Folder& folder, const Words& arguments, int code, const Launch& launch) {
  const Ended run = impinge(folder, joined(arguments, {"--json", "-"}), launch);
  EXPECT_EQ(run.code, code);
  EXPECT_EQ(run.err, "");
  json document = json::parse(run.out, nullptr, false);
  EXPECT_FALSE(document.is_discarded()) << run.out;
  return document;
}

std::string written(const std::function<void(report::Sink&)>& fill) {
  const int file = ::memfd_create("written", MFD_CLOEXEC);
  report::Sink sink(file, "memory");
  fill(sink);
  if (!sink.flush()) throw std::runtime_error("memory cannot be written");
  std::string text = contents(file);
  ::close(file);
  return text;
}

std::string keys(const json& object) {
  std::string names;
  for (const auto& item : object.items()) names += (names.empty() ? "" : " ") + item.key();
  return names;
}

void expect_members(const json& object, const json& expected) {
  for (const auto& [name, value] : expected.items()) EXPECT_EQ(object.value(name, json("missing")), value) << name;
}

std::string name_in(const json& report, const json& pair, const char* side) {
  return report.at("objects").at(pair.at(side).get<std::size_t>()).at("name");
}

Ended shell(const Folder& folder, const std::string& line) {
  Launch launch;
  const char* path = std::getenv("PATH");
  launch.environment["PATH"] =
      std::filesystem::path(IMPINGE_PROGRAM).parent_path().string() + ":" + (path != nullptr ? path : "/usr/bin:/bin");
  return Running(folder, {"/bin/sh", "-c", line}, launch).wait();
}

}  // namespace impinge::test
