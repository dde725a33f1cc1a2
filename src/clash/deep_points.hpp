// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "solid/part.hpp"

namespace impinge::clash {

/// A point of a solid's interior.
struct DeepPoint {
  Vec3 point;
  double depth;         ///< its distance from the boundary is at least this
  std::uint32_t shell;  ///< the nearest: nothing of the boundary is between it and the point
};

/// Up to three for each shell, deeper than what is enough if a few tries find such; none for a shell that is too thin.
std::vector<DeepPoint> deep_points(const solid::Part& part, double enough);

}  // namespace impinge::clash
