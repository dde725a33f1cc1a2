// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "clash/polygon.hpp"
#include "core/shapes.hpp"

namespace impinge::clash {

/// A flat convex body around a triangle. It holds the triangle with a margin on all sides, and each of its points is
/// certainly within the tolerance of the triangle.
struct Slab {
  static constexpr std::size_t kMostSides = 6;
  std::array<HalfSpace, kMostSides> sides;  ///< at right angles to the triangle's plane
  std::size_t size = 0;
  HalfSpace top, bottom;  ///< parallel to the plane; the triangle's normal points to the top
  Box box;
  bool has_plane = false;  ///< the triangle is wide enough for top and bottom to be its two sides
};

/// The least tolerance for slabs, as a share of the largest coordinate: below it floating point cannot keep points
/// apart.
inline constexpr double kLeastTolerance = 0x1p-36;

/// `triangle` is in local coordinates, which were rounded from coordinates up to `scale`. Nothing where the triangle is
/// neither so narrow that it may be taken for a segment nor wide enough for its plane to be known.
std::optional<Slab> make_slab(const Triangle& triangle, double tolerance, double scale);

/// A cube about a corner at which triangles are in vertex contact (clash/vertex_contact.hpp): it holds all points that
/// they share, with a margin, and each of its points is within the tolerance of each of them.
Slab make_corner_slab(const Vec3& corner, double tolerance);

/// The part of a convex polygon between the slab's sides, at any height over its triangle.
Polygon between(Polygon piece, const Slab& slab);

}  // namespace impinge::clash
