// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "core/vec3.hpp"

namespace impinge::clash {

/// What is no longer than this in the local frame is nothing: points there are off by a few 2^-53 of the largest world
/// coordinate, which is below 2 in local units.
inline constexpr double kRounding = 0x1p-46;

/// A triangle with its unit normal, or 0 if it has no area.
struct Facet {
  Triangle corners;
  Vec3 normal;
};

/// What two triangles in contact share, in double.
struct SharedPoints {
  std::array<Vec3, 6> points;
  std::uint8_t size = 0;  ///< 1: a point, 2: a segment along normal a x normal b, more: a polygon of flush triangles
};

/// Unit vectors with a sine of at most 2^-30, or 0: the line in which such planes cross is lost in rounding.
inline bool are_parallel(const Vec3& a, const Vec3& b) {
  const Vec3 way = cross(a, b);
  return dot(way, way) <= 0x1p-60;
}

/// Triangles in parallel planes count as flush. `a` and `b` share a point, in a frame where they are no longer than
/// about 1.
SharedPoints shared_points(const Facet& a, const Facet& b);

/// The unit vector, or 0 if it is shorter than 2^-500.
Vec3 unit_or_zero(const Vec3& v);

}  // namespace impinge::clash
