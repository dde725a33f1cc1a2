// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/body.hpp"

#include <utility>

#include "core/pose.hpp"

namespace impinge::solid {

Body make_body(const hierarchy::PlacedTree& placed) {
  std::vector<Vec3> vertices = placed.mesh->vertices;
  pose_all_vertices(placed.pose, vertices);
  Body body{placed,
            std::make_shared<const std::vector<Vec3>>(std::move(vertices)),
            {},
            {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}}};
  body.world = *body.vertices;
  for (const auto& triangle : placed.mesh->triangles) {
    for (const std::uint32_t vertex : triangle) {
      body.box.lo = min(body.box.lo, body.world[vertex]);
      body.box.hi = max(body.box.hi, body.world[vertex]);
    }
  }
  return body;
}

}  // namespace impinge::solid
