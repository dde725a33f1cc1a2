// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>

#include "exact/contact.hpp"
#include "impinge/measures.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

struct DepthGoal {
  /// The width of the interval relative to the depth. A width of 2^-42 of the largest coordinate always suffices.
  double precision = 0.01;
  /// The search ends when so many points have been examined, and four more for each pair of triangles that touch; the
  /// interval may then be wider than `precision`.
  std::uint64_t most_points = 1 << 17;
  double nothing = 0;  ///< depths up to this count as 0, as those up to some 2^-42 of the largest coordinate do
  std::stop_token stop{};
};

/// The greatest distance from the outer body's triangles over all points of the inner body's triangles that lie inside
/// the outer, closed body. The interval certainly contains it.
/// How often a body winds around a point, in whatever direction; it is inside if that is more than 1/2. A closed body
/// winds around all points between which none of its triangles is alike. Where one has cracks, a piece of a triangle
/// that touches none of its triangles is taken to lie on one side if its corners and its middle say so, with a number
/// below 1/4 or above 3/4.
struct Winding {
  std::function<double(const Vec3&)> at;
  bool closed = true;
};

/// The greatest distance from the outer body's triangles of all points of the inner body's triangles that are inside of
/// the outer body.
Interval depth_in(const solid::Body& inner, const solid::Body& outer, const Winding& winding, const DepthGoal& goal);

Interval depth_in(const solid::Body& inner, const solid::Body& outer, const DepthGoal& goal);

/// The depth of each solid in the other. Where no part of one boundary lies inside the other solid, the depth is
/// exactly 0. `contacts` are all pairs of triangles that share a point.
OverlapDepth depths_of(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
                       const DepthGoal& goal);

}  // namespace impinge::clash
