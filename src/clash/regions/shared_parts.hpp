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

/// The distances within which triangles are in contact, and points are one. Both are 0 for exact contacts.
struct Reach {
  double tolerance = 0;
  /// How finely lines of contact and outlines of areas are resolved: at most the tolerance, and at most a quarter of
  /// the width of the triangles in contact. With a coarser one nothing would be left of their borders.
  double resolution = 0;
};

/// What each of many pairs of triangles shares, in rows of corners. Pairs that share only a common vertex use one row
/// together, since two fans of n triangles make n² such pairs.
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
  /// Adds a row of one point, or reuses the last row of a point on these edges if the point is the same.
  void add_vertex(const Corner& corner);
  void append(const SharedParts& others);
  /// The greatest gap between two triangles where they share a part; 0 for exact contacts.
  [[nodiscard]] double gap() const { return gap_; }
  void widen_gap(double gap) { gap_ = std::max(gap_, gap); }
  void reserve(std::size_t rows) { rows_.reserve(rows); }

 private:
  static constexpr unsigned kSizeBits = 3, kMostCorners = 7;
  std::vector<std::uint64_t> rows_;  ///< where each row begins, and its size
  std::vector<Corner> corners_;
  double gap_ = 0;
  std::array<std::uint64_t, 64> vertex_rows_{};  ///< the row of the last vertex, by its edges
};

/// What each pair shares, with a tolerance as by shared_within. Throws `Stopped`.
SharedParts shared_parts(const solid::Body& a, const solid::Body& b, std::span<const exact::Contact> contacts,
                         const Reach& reach, const ForEach& for_each, const std::stop_token& stop);

}  // namespace impinge::clash
