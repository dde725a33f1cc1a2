// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/kd_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/stopped.hpp"

namespace impinge::clash {

int longest_axis(const Vec3& v) {
  const Vec3 size = abs(v);
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

KdTree::KdTree(std::vector<Vec3> points, const std::stop_token& stop)
    : points_(std::move(points)), order_(points_.size()), axis_(points_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  build({0, static_cast<std::uint32_t>(order_.size())}, stop);
}

void KdTree::build(Range range, const std::stop_token& stop) {
  throw_if_stopped(stop);
  if (range.last - range.first < 2) return;
  Box box{points_[order_[range.first]], points_[order_[range.first]]};
  for (std::uint32_t i = range.first; i < range.last; ++i)
    box = {min(box.lo, points_[order_[i]]), max(box.hi, points_[order_[i]])};
  const int axis = longest_axis(box.hi - box.lo);
  const auto begin = order_.begin();
  std::nth_element(
      begin + range.first, begin + range.middle(), begin + range.last,
      [&](std::uint32_t p, std::uint32_t q) { return component(points_[p], axis) < component(points_[q], axis); });
  axis_[range.middle()] = static_cast<std::uint8_t>(axis);
  build({range.first, range.middle()}, stop), build({range.middle() + 1, range.last}, stop);
}

}  // namespace impinge::clash
