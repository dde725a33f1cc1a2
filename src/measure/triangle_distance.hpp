// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"

/// Distances of triangles, segments and points, which degenerate triangles are, in double precision with a bound that
/// is computed for each answer: the width of a slab that separates the two.
namespace impinge::measure {

/// Of two closed triangles. Where they share a point, the distance may be above 0 if they cross: ask
/// `exact::classify`.
struct TriangleDistance {
  double distance;  ///< of a and b
  double margin;    ///< of rounding: a and b are within this of the triangles, and so is the distance of theirs
  double lower;     ///< no two points of the triangles are nearer, for certain
  Vec3 a, b;
};

/// Of triangles whose corners are in the exact domain. `enough_apart`: the nearest points are of no interest if they
/// are farther apart than that; then `distance` may be infinite, with `lower` above it. Where `guess` is across the gap
/// between them, which is quick to see, `lower` may be 4 margins less.
TriangleDistance triangle_distance(const Triangle& a, const Triangle& b, double enough_apart,
                                   const Vec3& guess = {0, 0, 0});

/// The point of a triangle nearest to `point`.
TriangleDistance point_distance(const Vec3& point, const Triangle& triangle, double enough_apart);

/// Two points of triangles that meet which are the same up to rounding.
std::array<Vec3, 2> common_point(const Triangle& a, const Triangle& b);

}  // namespace impinge::measure
