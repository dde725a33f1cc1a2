// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "core/vec3.hpp"

namespace impinge::clash {

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

/// Triangles count as flush if the sine between their planes is at most 2^-30: there the line in which planes cross is
/// lost in rounding. `a` and `b` share a point, in a frame where they are no longer than about 1.
SharedPoints shared_points(const Facet& a, const Facet& b);

/// The unit vector, or 0 if it is shorter than 2^-500.
Vec3 unit_or_zero(const Vec3& v);

}  // namespace impinge::clash
