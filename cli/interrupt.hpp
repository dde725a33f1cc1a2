// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <thread>

namespace impinge::cli {

/// While an object lives, SIGINT, SIGTERM and SIGHUP ask for a stop instead of ending the program; a second signal of
/// the same kind ends it at once. Signals that the caller had ignored stay ignored. Writing to a closed pipe, or more
/// than a file may hold, becomes an error instead of a signal. At most one object exists at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::jthread listener_;
};

}  // namespace impinge::cli
