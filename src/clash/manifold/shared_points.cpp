// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/manifold/shared_points.hpp"

#include <utility>

#include "core/shapes.hpp"

namespace impinge::clash {
namespace {

/// A part of the line in which two planes cross, by its ends' places along it.
struct Stretch {
  double low = kInfinity, high = -kInfinity;
  Vec3 from, to;

  void add(double at, const Vec3& p) {
    if (at < low) low = at, from = p;
    if (at > high) high = at, to = p;
  }
};

/// What of a triangle lies in the other's plane, corners as far as rounding too: where sides are flush, whole edges do.
/// The corner nearest to it where that leaves nothing.
Stretch in_plane(const Triangle& t, const Facet& plane, const Vec3& way) {
  std::array<double, 3> height{};
  std::size_t nearest = 0;
  const double rounding = kRounding * norm(way);
  for (std::size_t i = 0; i < 3; ++i) {
    height[i] = dot(plane.normal, t[i] - plane.corners[0]);
    if (std::abs(height[i]) < std::abs(height[nearest])) nearest = i;
    if (std::abs(height[i]) <= rounding) height[i] = 0;
  }
  Stretch stretch;
  const auto add = [&](const Vec3& p) { stretch.add(dot(way, p), p); };
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    if (height[i] == 0) add(t[i]);
    if (height[i] * height[next] < 0) add(t[i] + (height[i] / (height[i] - height[next])) * (t[next] - t[i]));
  }
  if (stretch.low > stretch.high) add(t[nearest]);
  return stretch;
}

/// The part of b's triangle over a's: clipped by each of its sides in turn (Sutherland and Hodgman, 1974).
SharedPoints flush_part(const Facet& a, const Facet& b) {
  SharedPoints result;
  for (const Vec3& corner : b.corners) result.points[result.size++] = corner;
  for (std::size_t side = 0; side < 3 && result.size > 0; ++side) {
    const Vec3& from = a.corners[side];
    const Vec3 inward = cross(a.normal, a.corners[(side + 1) % 3] - from);
    const SharedPoints before = std::exchange(result, {});
    for (std::size_t i = 0; i < before.size; ++i) {
      const Vec3 &p = before.points[i], &q = before.points[(i + 1) % before.size];
      const double at_p = dot(inward, p - from), at_q = dot(inward, q - from);
      // A convex polygon and a line: at most one corner more a side, if rounding does not see more crossings.
      if (at_p >= 0 && result.size < 6) result.points[result.size++] = p;
      if (at_p * at_q < 0 && result.size < 6) result.points[result.size++] = p + (at_p / (at_p - at_q)) * (q - p);
    }
  }
  return result;
}

}  // namespace

Vec3 unit_or_zero(const Vec3& v) {
  const double length = norm(v);
  return length > 0x1p-500 ? (1 / length) * v : Vec3{0, 0, 0};
}

SharedPoints shared_points(const Facet& a, const Facet& b) {
  const Vec3 way = cross(a.normal, b.normal);
  const bool are_proper = dot(a.normal, a.normal) > 0 && dot(b.normal, b.normal) > 0;
  const Box box = intersection(box_of(a.corners), box_of(b.corners));
  SharedPoints result;
  if (are_proper && are_parallel(a.normal, b.normal)) {
    result = flush_part(a, b);
  } else if (are_proper) {
    const Stretch of_a = in_plane(a.corners, b, way), of_b = in_plane(b.corners, a, way);
    const double low = std::max(of_a.low, of_b.low), high = std::min(of_a.high, of_b.high);
    result.points[0] = of_a.low > of_b.low ? of_a.from : of_b.from;
    result.points[1] = of_a.high < of_b.high ? of_a.to : of_b.to;
    result.size = low < high && norm(result.points[1] - result.points[0]) > kRounding ? 2 : 1;
  }
  if (result.size == 0) result = {{0.5 * box.lo + 0.5 * box.hi}, 1};
  // What is shared lies in both boxes, whatever rounding made of it.
  for (std::size_t i = 0; i < result.size; ++i) result.points[i] = min(max(result.points[i], box.lo), box.hi);
  return result;
}

}  // namespace impinge::clash
