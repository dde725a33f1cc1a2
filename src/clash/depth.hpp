// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "exact/contact.hpp"
#include "impinge/measures.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

struct DepthGoal {
  /// The width of the interval relative to the depth. A width of 2^-42 of the largest coordinate always suffices.
  double precision = 0.01;
  /// The search ends when so many points have been examined (256 boxes or 64 triangles tested count as one), and 4 more
  /// for each pair of triangles that touch; the interval may then be wider than `precision`.
  std::uint64_t most_points = 1 << 17;
  double nothing = 0;  ///< depths up to this count as 0, as those up to some 2^-42 of the largest coordinate do
  /// Depths that the caller will hold the answer against: beyond `precision` the search goes on while one of them is in
  /// [lo, hi), down to a width of `nothing`. They decide only where it ends, not its order.
  std::vector<double> levels{};
  double enough = 0;       ///< the search also ends as soon as no depth is above this
  double known = 0;        ///< nothing is asked of depths that are less, to `precision`
  std::stop_token stop{};  ///< ends the search early, or by `Stopped`
};

/// How often a body winds around a point, in whatever direction; it is inside if that is more than 1/2. A closed body
/// winds around all points between which none of its triangles is alike, and so does one with cracks unless an open
/// edge is near. There a piece of a triangle that touches none of its triangles is taken to lie on one side if its
/// corners, and of a whole triangle the middle, say so, with a number below 1/4 or above 3/4.
struct Winding {
  std::function<double(const Vec3&)> at;
  bool closed = true;
  /// How far an open edge is from a point, if not farther than so much; infinity otherwise.
  std::function<double(const Vec3&, double within)> to_open_edge{};
};

/// The pairs of triangles of two bodies that may touch, roundings considered.
std::vector<TrianglePair> touching_pairs(const solid::Body& a, const solid::Body& b, const std::stop_token& stop);

struct Depth : Interval {
  Vec3 deepest{};  ///< the point that is at least so deep, if `lo` is not 0
};

struct DepthSearch {
  const solid::Body &inner, &outer;
  const Winding& winding;
  std::span<const TrianglePair> touching;  ///< triangles of the inner with such of the outer body
};

/// The greatest distance from the outer body's triangles of all points of the inner body's triangles that are inside of
/// the outer body. The interval certainly contains it.
Depth depth_in(const DepthSearch& search, const DepthGoal& goal);

/// The same of a closed outer body.
Interval depth_in(const solid::Body& inner, const solid::Body& outer, const DepthGoal& goal);

/// The depth of each solid in the other. Where no part of one boundary lies inside the other solid, the depth is
/// exactly 0. `contacts` are all pairs of triangles that share a point.
OverlapDepth depths_of(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
                       const DepthGoal& goal);

}  // namespace impinge::clash
