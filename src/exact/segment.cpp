// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/segment.hpp"

#include <tuple>

namespace impinge::exact {
namespace {

bool lexicographically_less(const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

bool in_box(const Vec3& p, const Segment& s) {
  const Vec3 lo = min(s[0], s[1]), hi = max(s[0], s[1]);
  return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z && p.z <= hi.z;
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) { return find_projection(a, b, c) < 0; }

}  // namespace

int find_projection(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int i = 0; i < 3; ++i)
    if (orient2d(kProjections[i], a, b, c) != 0) return i;
  return -1;
}

Segment extremes(const Triangle& t) {
  const auto [lo, hi] = std::minmax({t[0], t[1], t[2]}, lexicographically_less);
  return {lo, hi};
}

bool intersects(const Vec3& point, const Segment& segment) {
  return in_box(point, segment) && collinear(point, segment[0], segment[1]);
}

bool intersects(const Segment& a, const Segment& b) {
  if (a[0] == a[1]) return intersects(a[0], b);
  if (b[0] == b[1]) return intersects(b[0], a);
  int projection = find_projection(a[0], a[1], b[0]);
  if (projection < 0) projection = find_projection(a[0], a[1], b[1]);
  if (projection < 0) {  // one line: they meet if and only if one holds an end of the other
    return in_box(a[0], b) || in_box(a[1], b) || in_box(b[0], a) || in_box(b[1], a);
  }
  if (orient3d(a[0], a[1], b[0], b[1]) != 0) return false;
  const Projection& p = kProjections[projection];
  const int b0 = orient2d(p, a[0], a[1], b[0]), b1 = orient2d(p, a[0], a[1], b[1]);
  const int a0 = orient2d(p, b[0], b[1], a[0]), a1 = orient2d(p, b[0], b[1], a[1]);
  return b0 * b1 <= 0 && a0 * a1 <= 0;  // two lines: each segment reaches the other's line
}

// Separating axes in the plane: the edges of the sum of a triangle and a (mirrored) segment are parallel to the edges
// of the two, so closed sets that do not meet are separated strictly by a line along one of these four.
bool intersects_in_plane(const Segment& segment, const Triangle& t, const Projection& p) {
  const int turn = orient2d(p, t[0], t[1], t[2]);
  for (int i = 0; i < 3; ++i) {
    const Vec3 &from = t[i], &to = t[(i + 1) % 3];
    if (orient2d(p, from, to, segment[0]) * turn < 0 && orient2d(p, from, to, segment[1]) * turn < 0) return false;
  }
  const int s0 = orient2d(p, segment[0], segment[1], t[0]);
  return s0 == 0 || s0 != orient2d(p, segment[0], segment[1], t[1]) || s0 != orient2d(p, segment[0], segment[1], t[2]);
}

bool intersects(const Segment& segment, const Triangle& t) {
  const int s0 = orient3d(t[0], t[1], t[2], segment[0]);
  const int s1 = orient3d(t[0], t[1], t[2], segment[1]);
  if (s0 * s1 > 0) return false;
  if (s0 * s1 < 0) {  // the line through the segment passes the triangle's edges all on one side, or meets one
    const int e0 = orient3d(segment[0], segment[1], t[0], t[1]);
    const int e1 = orient3d(segment[0], segment[1], t[1], t[2]);
    if (e0 * e1 < 0) return false;
    const int e2 = orient3d(segment[0], segment[1], t[2], t[0]);
    return e0 * e2 >= 0 && e1 * e2 >= 0;
  }
  // Only the ends in the plane can meet the triangle.
  const Segment in_plane{s0 == 0 ? segment[0] : segment[1], s1 == 0 ? segment[1] : segment[0]};
  return intersects_in_plane(in_plane, t, kProjections[find_projection(t[0], t[1], t[2])]);
}

}  // namespace impinge::exact
