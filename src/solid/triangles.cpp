// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/triangles.hpp"

#include <algorithm>
#include <vector>

#include "exact/orientation.hpp"
#include "exact/segment.hpp"

namespace impinge::solid {
namespace {

const exact::Projection& projection_of(const Triangle& t) {
  return exact::kProjections[exact::find_projection(t[0], t[1], t[2])];
}

/// On which sides of a plane a triangle has vertices, and its vertices on the plane.
struct Sides {
  bool above = false, below = false;
  std::vector<Vec3> on;
  Sides(const Triangle& t, const Triangle& plane) {
    for (const Vec3& v : t) {
      const int side = exact::orient3d(plane[0], plane[1], plane[2], v);
      above |= side > 0, below |= side < 0;
      if (side == 0) on.push_back(v);
    }
  }
};

/// Whether a point or segment in the triangle's plane meets its interior. It does unless the line of an edge, or of the
/// segment, separates the two.
bool meets_inside(const std::vector<Vec3>& points, const Triangle& t) {
  const exact::Projection& p = projection_of(t);
  const int inner = exact::orient2d(p, t[0], t[1], t[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto is_beyond = [&](const Vec3& v) { return exact::orient2d(p, t[i], t[(i + 1) % 3], v) * inner <= 0; };
    if (std::all_of(points.begin(), points.end(), is_beyond)) return false;
  }
  if (points.size() < 2) return true;
  bool left = false, right = false;
  for (const Vec3& v : t) {
    const int turn = exact::orient2d(p, points[0], points[1], v);
    left |= turn > 0, right |= turn < 0;
  }
  return left && right;
}

}  // namespace

// A touching pair is not coplanar. Unless the plane of `reaching` passes through the inside of `t`, what they share is
// on an edge of `t`. If both pass through the other's plane, each has an interval of the common line, open inside;
// since the insides do not meet, the closed intervals share an end alone. What is left is a vertex or an edge of
// `reaching` in the plane of `t`.
bool reaches_inside(const Triangle& reaching, const Triangle& t) {
  const Sides own(reaching, t);
  if (own.on.empty() || (own.above && own.below)) return false;
  const Sides other(t, reaching);
  return other.above && other.below && meets_inside(own.on, t);
}

bool covers(const Triangle& cover, const Triangle& t) {
  const exact::Projection& p = projection_of(cover);
  const int inner = exact::orient2d(p, cover[0], cover[1], cover[2]);
  for (std::size_t i = 0; i < 3; ++i)
    for (const Vec3& v : t)
      if (exact::orient2d(p, cover[i], cover[(i + 1) % 3], v) * inner < 0) return false;
  return true;
}

bool same_orientation(const Triangle& a, const Triangle& b) {
  const exact::Projection& p = projection_of(a);
  return exact::orient2d(p, a[0], a[1], a[2]) == exact::orient2d(p, b[0], b[1], b[2]);
}

}  // namespace impinge::solid
