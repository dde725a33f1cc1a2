// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/body.hpp"

#include "core/pose.hpp"

namespace impinge::solid {

Body make_body(const hierarchy::PlacedTree& placed) {
  Body body{placed, placed.mesh->vertices, {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}}};
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
