// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>

#include "exact/contact.hpp"
#include "impinge/measures.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

struct DepthGoal {
  /// Of the width of the interval, relative to the depth. 2^-42 of the largest coordinate is no width.
  double precision = 0.01;
  /// Looked at in all, and four more for each pair of triangles that touch; then the interval stays as wide as it is.
  std::uint64_t most_points = 1 << 17;
  std::stop_token stop{};
};

/// The greatest distance of a point of one body's triangles that lies inside the other, a closed one, from the other's
/// triangles. The interval holds it for certain.
Interval depth_in(const solid::Body& inner, const solid::Body& outer, const DepthGoal& goal);

/// Both ways round. Where no part of one boundary lies inside the other solid, that depth is 0 exactly. `contacts` are
/// all pairs of triangles that share a point.
OverlapDepth depths_of(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
                       const DepthGoal& goal);

}  // namespace impinge::clash
