// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/hash.hpp"
#include "core/shapes.hpp"

namespace impinge {

/// Numbers different points in the order in which they first come: an open hash table, flat, so that one of millions of
/// points is freed at once.
class PointTable {
 public:
  explicit PointTable(std::size_t expected = 0) : slots_(std::bit_ceil(2 * expected + 16)) {}

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(points_.size()); }
  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }  ///< by their numbers

  /// The point's number, which is the size of before if the point is new.
  std::uint32_t add(const Vec3& point) {
    if (2 * points_.size() >= slots_.size()) grow();
    std::uint32_t& slot = slots_[slot_of(point)];
    if (slot == 0) points_.push_back(point), slot = size();
    return slot - 1;
  }

  [[nodiscard]] std::optional<std::uint32_t> find(const Vec3& point) const {
    const std::uint32_t slot = slots_[slot_of(point)];
    return slot > 0 ? std::optional(slot - 1) : std::nullopt;
  }

 private:
  /// Where the point is, or would be put.
  [[nodiscard]] std::size_t slot_of(const Vec3& p) const {
    std::size_t slot = mix(mix(number_bits(p.x), number_bits(p.y)), number_bits(p.z)) & (slots_.size() - 1);
    while (slots_[slot] != 0 && points_[slots_[slot] - 1] != p) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow() {
    slots_.assign(2 * slots_.size(), 0);
    for (std::uint32_t i = 0; i < points_.size(); ++i) slots_[slot_of(points_[i])] = i + 1;
  }

  std::vector<Vec3> points_;
  std::vector<std::uint32_t> slots_;  ///< a number + 1, or 0; at most half of them are taken
};

}  // namespace impinge
