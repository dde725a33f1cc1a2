// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "core/shapes.hpp"

namespace impinge::clash {

/// A k-d tree over points, which finds those near a segment.
class KdTree {
 public:
  KdTree(std::vector<Vec3> points, const std::stop_token& stop);

  /// Calls visit(i) with the index of each point within `margin` of the segment, and of some that are farther. Only the
  /// piece of the segment that is in a half of the tree is followed there: few points are close to a long segment,
  /// though its box may hold them all. The margin must exceed the rounding of the pieces' ends, a few 2^-53 of the
  /// largest coordinate.
  template <class Visit>
  void near(const Segment& segment, double margin, const Visit& visit) const {
    search({0, static_cast<std::uint32_t>(order_.size())}, segment, margin, visit);
  }

 private:
  struct Range {
    std::uint32_t first, last;
    [[nodiscard]] std::uint32_t middle() const { return first + (last - first) / 2; }
  };

  void build(Range range, const std::stop_token& stop);
  template <class Visit>
  void search(Range range, const Segment& segment, double margin, const Visit& visit) const {
    if (range.first == range.last) return;
    const std::uint32_t middle = range.middle();
    visit(order_[middle]);
    const int axis = axis_[middle];
    const double split = component(points_[order_[middle]], axis);
    const double from = component(segment[0], axis), to = component(segment[1], axis);
    for (const double side : {-1.0, 1.0}) {
      const double border = split - side * margin;
      const bool has_from = side * (from - border) >= 0, has_to = side * (to - border) >= 0;
      if (!has_from && !has_to) continue;
      Segment half = segment;
      if (!has_from || !has_to)
        half[has_from ? 1 : 0] = segment[0] + (border - from) / (to - from) * (segment[1] - segment[0]);
      search(side < 0 ? Range{range.first, middle} : Range{middle + 1, range.last}, half, margin, visit);
    }
  }

  std::vector<Vec3> points_;
  std::vector<std::uint32_t> order_;  ///< indices of points: the middle of each range is the root of a subtree
  std::vector<std::uint8_t> axis_;    ///< along which the root in each place of `order_` parts the rest
};

/// The axis along which a vector is longest.
int longest_axis(const Vec3& v);

}  // namespace impinge::clash
