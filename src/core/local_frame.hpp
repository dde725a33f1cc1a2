// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/shapes.hpp"

namespace impinge {

/// Coordinates about a middle, scaled by a power of two so that squares neither over- nor underflow.
struct LocalFrame {
  Vec3 origin;
  double unit;   ///< local per world
  double scale;  ///< the largest |world coordinate|, in local units: 1 to 2

  [[nodiscard]] Vec3 to_local(const Vec3& p) const { return unit * (p - origin); }
  [[nodiscard]] Vec3 to_world(const Vec3& p) const { return origin + (1 / unit) * p; }
  [[nodiscard]] Triangle to_local(const Triangle& t) const { return {to_local(t[0]), to_local(t[1]), to_local(t[2])}; }
};

/// The largest |coordinate| in a box; 0 in an empty one.
double largest_coordinate(const Box& box);

/// The frame for points in either box: about the middle of the smaller one.
LocalFrame local_frame(const Box& a, const Box& b);

}  // namespace impinge
