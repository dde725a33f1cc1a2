// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/contact.hpp"

namespace impinge::results {

/// Keeps the wanted contacts, and with a limit no more than about twice as many as may be in the answer.
class Collector {
 public:
  Collector(std::uint8_t kinds, std::uint64_t limit) : kinds_(kinds), limit_(limit) {}

  void add(std::span<const exact::Contact> contacts);
  [[nodiscard]] bool wants(Kind kind) const { return (kinds_ >> static_cast<int>(kind) & 1) != 0; }

  [[nodiscard]] const std::vector<exact::Contact>& kept() const { return kept_; }
  [[nodiscard]] std::uint64_t seen() const { return seen_; }

 private:
  std::uint8_t kinds_;
  std::uint64_t limit_;
  std::uint64_t seen_ = 0;  ///< wanted contacts, kept or not
  std::vector<exact::Contact> kept_;
};

/// Canonical order (CONTRACT 7).
bool precedes(const exact::Contact& p, const exact::Contact& q);

}  // namespace impinge::results
