// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/body.hpp"

#include <limits>

#include "core/pose.hpp"

namespace impinge::solid {

Body make_body(const hierarchy::PlacedTree& placed) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Body body{placed, placed.mesh->vertices, {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}}};
  pose_all_vertices(placed.pose, body.world);
  for (const auto& triangle : placed.mesh->triangles) {
    for (const std::uint32_t vertex : triangle) {
      body.box.lo = min(body.box.lo, body.world[vertex]);
      body.box.hi = max(body.box.hi, body.world[vertex]);
    }
  }
  return body;
}

}  // namespace impinge::solid
