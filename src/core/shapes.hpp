// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"

namespace impinge {

struct Sphere {
  Vec3 center{0, 0, 0};
  double radius = 0;
};

/// Closed and axis-aligned; empty when some lo exceeds its hi.
struct Box {
  Vec3 lo, hi;
};

inline constexpr Box kEmpty{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

inline Box intersection(const Box& a, const Box& b) { return {max(a.lo, b.lo), min(a.hi, b.hi)}; }
inline bool is_empty(const Box& box) { return box.lo.x > box.hi.x || box.lo.y > box.hi.y || box.lo.z > box.hi.z; }
/// Exact: comparisons only.
inline bool overlap(const Box& a, const Box& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
         b.lo.z <= a.hi.z;
}
inline Box box_of(const Segment& s) { return {min(s[0], s[1]), max(s[0], s[1])}; }
inline Box box_of(const Triangle& t) { return {min(min(t[0], t[1]), t[2]), max(max(t[0], t[1]), t[2])}; }

}  // namespace impinge
