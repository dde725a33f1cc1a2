// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// Runs the built program as a shell would, with everything that it says caught.
namespace impinge::test {

/// What a page of impinge begins with, and the file in which its program is.
inline const std::string kPageHead =
    "<!doctype html>\n<!-- SPDX-FileCopyrightText: The impinge authors; SPDX-License-Identifier: MIT -->\n";

/// A fresh folder that goes away with all that is in it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, std::string_view text) const;
  [[nodiscard]] std::string read(const std::string& name) const;
  /// The names of all that is in it, sorted.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

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

/// Runs `impinge` in the folder and waits for it.
Ended impinge(const Folder& folder, const std::vector<std::string>& arguments, const Launch& launch = {});

/// Runs a line of shell in the folder, with the program on the PATH.
Ended shell(const Folder& folder, const std::string& line);

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
