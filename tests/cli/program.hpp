// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/sink.hpp"
#include "tests/core/folder.hpp"

/// Runs the built program as a shell would, with everything that it says caught.
namespace impinge::test {

/// What a page of impinge begins with, and the file in which its program is.
inline const std::string kPageHead =
    "<!doctype html>\n<!-- SPDX-FileCopyrightText: The impinge authors; SPDX-License-Identifier: MIT -->\n";

struct Ended {
  int code = -1;    ///< the exit code; -1 if a signal ended the program
  int signal = 0;   ///< the signal that ended it
  std::string out;  ///< standard output, where it was not sent elsewhere
  std::string err;
};

struct Launch {
  std::map<std::string, std::string> environment{};  ///< beside the test's own, which loses COLUMNS and TERM
  int out = -1;                                      ///< a descriptor for standard output in place of the catching one
  int err = -1;
  bool close_out = false;  ///< start without a standard output at all
};

/// The words of a command line and more of them.
std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more);

/// Runs `impinge` in the folder and waits for it.
Ended impinge(const Folder& folder, const std::vector<std::string>& arguments, const Launch& launch = {});

/// Runs a line of shell in the folder, with the program on the PATH.
Ended shell(const Folder& folder, const std::string& line);

/// What `fill` writes.
std::string written(const std::function<void(report::Sink&)>& fill);

/// The keys of an object, sorted, with a space between them.
std::string keys(const nlohmann::json& object);

/// The name of the object that `pair` has on this side, "a" or "b".
std::string name_in(const nlohmann::json& report, const nlohmann::json& pair, const char* side);

/// A program that is still running.
class Running {
 public:
  Running(const Folder& folder, const std::vector<std::string>& words, const Launch& launch = {});
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  /// Waits until the program itself handles this signal, so that it can be sent without racing its start.
  [[nodiscard]] bool handles(int signal, std::chrono::seconds patience) const;
  void send(int signal) const;
  Ended wait();

 private:
  pid_t process_ = -1;
  int out_ = -1, err_ = -1;
};

}  // namespace impinge::test
