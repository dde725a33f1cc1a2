// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <vector>

#include "core/vec3.hpp"

namespace impinge::test {

/// The winding number by the plain sum of solid angles, each by the spherical excess of its sides (l'Huilier).
inline double plain_winding(const std::vector<Triangle>& triangles, const Vec3& p) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    std::array<Vec3, 3> to{};
    for (std::size_t i = 0; i < 3; ++i) to[i] = (1 / norm(t[i] - p)) * (t[i] - p);
    std::array<double, 3> side{};
    for (std::size_t i = 0; i < 3; ++i) side[i] = 2 * std::asin(std::min(1.0, norm(to[(i + 1) % 3] - to[i]) / 2));
    const double half = (side[0] + side[1] + side[2]) / 2;
    const double product = std::tan(half / 2) * std::tan((half - side[0]) / 2) * std::tan((half - side[1]) / 2) *
                           std::tan((half - side[2]) / 2);
    const double excess = 4 * std::atan(std::sqrt(std::max(0.0, product)));
    sum += dot(to[0], cross(to[1], to[2])) < 0 ? -excess : excess;
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace impinge::test
