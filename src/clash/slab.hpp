// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "clash/polygon.hpp"
#include "core/shapes.hpp"

namespace impinge::clash {

/// A flat convex body that holds a triangle, with a margin on all sides, and every point of which is within the
/// tolerance of the triangle, for certain.
struct Slab {
  static constexpr std::size_t kMostSides = 6;
  std::array<HalfSpace, kMostSides> sides;  ///< across the triangle's plane
  std::size_t size = 0;
  HalfSpace top, bottom;  ///< along it: top on the side that the triangle's normal points to
  Box box;
  bool has_plane = false;  ///< the triangle is wide enough for top and bottom to be its two sides
};

/// What floating point may be asked to keep apart: below this part of the largest coordinate there is no slab.
inline constexpr double kLeastTolerance = 0x1p-36;

/// `triangle` is in local coordinates, and `scale` the largest coordinate that they were rounded from. Nothing where
/// the triangle is neither so narrow that it may be taken for a segment nor wide enough for its plane to be told.
std::optional<Slab> make_slab(const Triangle& triangle, double tolerance, double scale);

/// About a corner in which triangles vertex_contact (clash/vertex_contact.hpp): holds what they share, with a margin,
/// and every point of it is within the tolerance of each of them.
Slab make_corner_slab(const Vec3& corner, double tolerance);

/// What of a convex polygon lies between the slab's sides: over its triangle, however far.
Polygon between(Polygon piece, const Slab& slab);

}  // namespace impinge::clash
