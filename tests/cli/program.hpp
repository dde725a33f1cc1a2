// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
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

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Those of a command line.
using Words = std::vector<std::string>;

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
Words joined(Words words, const Words& more);

/// Runs `impinge` in the folder and waits for it.
Ended impinge(const Folder& folder, const Words& arguments, const Launch& launch = {});

/// The sentence of a run that failed: exit code 2, and one line on standard error that begins with "impinge: ".
std::string sentence_of(const Ended& run);

/// That of `impinge` with these arguments, which prints nothing else.
std::string refusal(const Folder& folder, const Words& arguments, const Launch& launch = {});

/// The document that `impinge` writes to standard output with these arguments and `--json -`; it says nothing beside
/// it, and ends with this code.
json document(const Folder& folder, const Words& arguments, int code, const Launch& launch = {});

/// Runs a line of shell in the folder, with the program on the PATH.
Ended shell(const Folder& folder, const std::string& line);

/// What `fill` writes.
std::string written(const std::function<void(report::Sink&)>& fill);

/// The keys of an object, sorted, with a space between them.
std::string keys(const json& object);

/// Fails where a member of `expected` is missing in `object`, or has another value there.
void expect_members(const json& object, const json& expected);

/// The name of the object that `pair` has on this side, "a" or "b".
std::string name_in(const json& report, const json& pair, const char* side);

/// A program that is still running.
class Running {
 public:
  Running(const Folder& folder, const Words& words, const Launch& launch = {});
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
