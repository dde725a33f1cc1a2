// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/box_path.hpp"

#include <cmath>

namespace impinge::motion {

namespace {

Box box_of_corners(std::span<const Vec3> vertices, std::span<const Corners> triangles) {
  Box box{vertices[triangles[0][0]], vertices[triangles[0][0]]};
  for (const Corners& corners : triangles)
    for (const std::uint32_t vertex : corners) box = {min(box.lo, vertices[vertex]), max(box.hi, vertices[vertex])};
  return box;
}

// The gap at `end` is off by less than 2^-50 of both gaps: two differences, a difference, a product and a sum, each
// rounded once; 2^-1000 is far more than underflow takes.
bool positive_until(double at0, double at1, double end) {
  if (!(at0 > 0)) return false;
  return at1 > 0 || at0 + end * (at1 - at0) > 0x1p-50 * (at0 + std::abs(at1)) + 0x1p-1000;
}

}  // namespace

BoxPath path_of(const Vertices& vertices, std::span<const Corners> triangles) {
  return {box_of_corners(vertices.from, triangles), box_of_corners(vertices.to, triangles)};
}

BoxPath grown(const BoxPath& path, double separation) {
  if (separation == 0) return path;
  const Vec3 extents = max(path.from.hi, path.to.hi) - min(path.from.lo, path.to.lo);
  const double by = separation * (0.5 + 0x1p-10) + 0x1p-31 * max_component(extents);
  const auto around = [by](const Box& box) {
    const auto out = [](const Vec3& v, double way) {
      return Vec3{std::nextafter(v.x, way), std::nextafter(v.y, way), std::nextafter(v.z, way)};
    };
    const Vec3 margin{by, by, by};
    return Box{out(box.lo - margin, -kInfinity), out(box.hi + margin, kInfinity)};
  };
  return {around(path.from), around(path.to)};
}

bool stay_apart(const BoxPath& a, const BoxPath& b, double end) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto gap = [&](const Box& low, const Box& high) {
      return component(high.lo, axis) - component(low.hi, axis);
    };
    if (positive_until(gap(a.from, b.from), gap(a.to, b.to), end) ||
        positive_until(gap(b.from, a.from), gap(b.to, a.to), end))
      return true;
  }
  return false;
}

}  // namespace impinge::motion
