// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "impinge/contacts.hpp"

namespace impinge {

/// Memory that queries keep for the next one. With a workspace of one's own, given back its `Contacts` when they are
/// done with, a steady series of queries on one thread allocates nothing. One query uses a workspace at a time.
class Workspace {
 public:
  Workspace();
  ~Workspace();
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  /// Takes the memory of an answer for the next one.
  void recycle(Contacts&& contacts);

  /// Internal.
  struct State;
  [[nodiscard]] State& state() noexcept { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

}  // namespace impinge
