// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>

#include "core/pose.hpp"
#include "core/vec3.hpp"

namespace impinge::test {

/// About the point of a mesh that `pose` brings to `world`: by transposition, with Newton repairing what R is off.
inline Vec3 unposed(const Point& world, const Pose& pose) {
  const Mat3 inverse = transpose(to_mat3(pose.R));
  Vec3 x = inverse * (world - Vec3{pose.t[0], pose.t[1], pose.t[2]});
  for (int i = 0; i < 4; ++i) x = x + inverse * (world - world_vertex(pose, x));
  return x;
}

/// A vertex that `pose` brings to `world` bit for bit; nothing where rounding leaves none nearby.
inline std::optional<Vec3> pinned(const Point& world, const Pose& pose) {
  const Vec3 x = unposed(world, pose);
  const auto nudged = [](double a, int ulps) {
    for (; ulps > 0; --ulps) a = std::nextafter(a, 1e300);
    for (; ulps < 0; ++ulps) a = std::nextafter(a, -1e300);
    return a;
  };
  for (int i = 0; i < 125; ++i) {
    const Vec3 y{nudged(x.x, i % 5 - 2), nudged(x.y, i / 5 % 5 - 2), nudged(x.z, i / 25 - 2)};
    if (world_vertex(pose, y) == world) return y;
  }
  return std::nullopt;
}

}  // namespace impinge::test
