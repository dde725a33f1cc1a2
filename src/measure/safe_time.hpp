// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/twist.hpp"
#include "measure/nearest.hpp"

namespace impinge::measure {

/// A body that is under way.
struct MovingTree {
  const hierarchy::PlacedTree& body;  ///< where it is now
  const Twist& twist;
};

/// What a search for the time until two bodies meet is told.
struct Approach {
  double within;     ///< later times are of no interest
  double slack;      ///< a distance that is kept: what is nearer has met
  double tolerance;  ///< above the slack: what is not above it, and has no longer way to go, has met as well
};

struct SafeTime {
  double time = 0;                   ///< until then no two triangles come as near as the slack
  bool is_limited = true;            ///< false: all the time that is looked at
  std::optional<NearestPair> met{};  ///< two triangles that have met now; the distance is 0 if they share a point
};

/// The triangles that limited the time of an earlier search are the first to be looked at.
struct LimitingPair {
  std::uint32_t triangle_a = 0, triangle_b = 0;
};

/// How long two moving bodies surely do not meet, by branch and bound over both trees: two nodes do not meet for the
/// time that their distance takes at the speeds of their fastest points. So few nodes are opened where the parts that
/// are near the other body are slow. A search that was stopped answers with a time of 0.
SafeTime safe_time(const MovingTree& a, const MovingTree& b, const Approach& approach, LimitingPair& last,
                   const SearchMeans& means);

}  // namespace impinge::measure
