// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "solid/part.hpp"

namespace impinge::clash {

/// A point in the interior of a solid.
struct DeepPoint {
  Vec3 point;
  double depth;         ///< a lower bound of its distance from the boundary
  std::uint32_t shell;  ///< the nearest shell: no other part of the boundary lies between it and the point
};

/// Up to three points for each shell of a solid. A few places are tried, until three points are deeper than `enough`; a
/// shell that is too thin has none.
std::vector<DeepPoint> deep_points(const solid::Part& part, double enough);

}  // namespace impinge::clash
