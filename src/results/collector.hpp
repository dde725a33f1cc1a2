// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "results/contact_key.hpp"

namespace impinge::results {

/// Contacts of one pair of objects that follow each other in a collector.
struct Run {
  std::uint32_t object_pair;
  std::size_t count;
};

/// Keeps the wanted contacts of one thread, and with a limit no more than about twice as many as may be in the answer.
class Collector {
 public:
  /// Forgets everything but the memory.
  void restart(std::uint8_t kinds, std::uint64_t limit);

  void add(std::uint32_t object_pair, std::span<const ContactKey> contacts);
  [[nodiscard]] bool wants(Kind kind) const { return (kinds_ >> static_cast<int>(kind) & 1) != 0; }

  [[nodiscard]] std::span<const ContactKey> kept() const { return kept_; }
  [[nodiscard]] std::span<const Run> runs() const { return runs_; }
  [[nodiscard]] std::uint64_t seen() const { return seen_; }

 private:
  void drop_beyond_limit();

  std::uint8_t kinds_ = kAllKinds;
  std::uint64_t limit_ = 0;
  std::uint64_t seen_ = 0;  ///< wanted contacts, kept or not
  std::vector<ContactKey> kept_;
  std::vector<Run> runs_;
};

}  // namespace impinge::results
