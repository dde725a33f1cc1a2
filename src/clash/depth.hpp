// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <stop_token>

#include "impinge/measures.hpp"
#include "solid/body.hpp"

namespace impinge::clash {

struct DepthGoal {
  double precision = 0.01;              ///< of the width of the interval, relative to the depth
  std::uint64_t most_points = 1 << 18;  ///< looked at in all; then the interval stays as wide as it is
  std::stop_token stop{};
};

/// The greatest distance of a point of one body's triangles that lies inside the other, a closed one, from the other's
/// triangles. The interval holds it for certain.
Interval depth_in(const solid::Body& inner, const solid::Body& outer, const DepthGoal& goal);

}  // namespace impinge::clash
