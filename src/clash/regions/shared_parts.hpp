// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "clash/regions/shared_part.hpp"
#include "core/for_each.hpp"
#include "exact/contact.hpp"
#include "solid/body.hpp"

namespace impinge::clash {

/// What counts as in contact, and as one. Both 0: exactly.
struct Reach {
  double tolerance = 0;
  /// How finely lines of contact and outlines of areas are told: within the tolerance, but also within a quarter of how
  /// wide the triangles in contact are. If more were one point, nothing would be left of their borders.
  double resolution = 0;
};

/// What each of many pairs shares. Pairs that meet in a common vertex alone have one row together: a fan of n
/// triangles on another is n² of them.
class SharedParts {
 public:
  [[nodiscard]] std::span<const Corner> operator[](std::size_t contact) const {
    return {corners_.data() + (rows_[contact] >> kSizeBits), rows_[contact] & kMostCorners};
  }
  [[nodiscard]] std::span<const Corner> corners() const { return corners_; }

  void add(std::span<const Corner> part) {
    rows_.push_back(corners_.size() << kSizeBits | part.size());
    corners_.insert(corners_.end(), part.begin(), part.end());
  }
  /// A point on these edges, in the row of the last such one where that is the same.
  void add_vertex(const Corner& corner);
  void append(const SharedParts& others);
  /// The farthest that what shares some part is apart: 0 of exact ones.
  [[nodiscard]] double gap() const { return gap_; }
  void widen_gap(double gap) { gap_ = std::max(gap_, gap); }
  void reserve(std::size_t rows) { rows_.reserve(rows); }

 private:
  static constexpr unsigned kSizeBits = 3, kMostCorners = 7;
  std::vector<std::uint64_t> rows_;  ///< where it begins and its size
  std::vector<Corner> corners_;
  double gap_ = 0;
  std::array<std::uint64_t, 64> vertex_rows_{};  ///< of the last vertex on these edges
};

/// With a tolerance, what each pair shares within it (`shared_within`). Incomplete if stopped.
SharedParts shared_parts(const solid::Body& a, const solid::Body& b, std::span<const exact::Contact> contacts,
                         const Reach& reach, const ForEach& for_each, const std::stop_token& stop);

}  // namespace impinge::clash
