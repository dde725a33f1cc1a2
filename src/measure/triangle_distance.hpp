// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"

/// Distances of triangles, also of degenerate ones, in double precision with a bound that is
/// computed for each answer: the width of a slab that separates the two.
namespace impinge::measure {

/// The distance of two closed triangles. If they cross it may be above 0: use `exact::classify` for these.
struct TriangleDistance {
  double distance;  ///< between a and b
  double margin;    ///< bounds the distance of a and b from the triangles, and the error of `distance`
  double lower;     ///< certainly no two points of the triangles are nearer
  Vec3 a, b;
};

/// The corners must be `in_range`. Nearest points farther apart than `enough_apart` are not needed: then
/// `distance` may be infinite, with `lower` above `enough_apart`. If the direction `guess` already separates the
/// triangles, which is quick to test, `lower` may be 4 margins less.
TriangleDistance triangle_distance(const Triangle& a, const Triangle& b, double enough_apart,
                                   const Vec3& guess = {0, 0, 0});

/// The point of a triangle nearest to `point`.
TriangleDistance point_distance(const Vec3& point, const Triangle& triangle, double enough_apart);

/// A point that two triangles share, as computed on either: the two are equal up to rounding.
std::array<Vec3, 2> common_point(const Triangle& a, const Triangle& b);

}  // namespace impinge::measure
