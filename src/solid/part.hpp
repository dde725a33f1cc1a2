// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solid/body.hpp"
#include "solid/topology.hpp"

namespace impinge::solid {

/// A body with its topology: adjacency, open edges, and shells with their sides.
struct Part {
  Body body;
  Topology topology;
  bool solid = false;
  /// Per shell of a solid: whether the side that its triangles' normals point to (front), and the other one, are
  /// interior. A shell with both or neither is an internal wall, which is no part of the boundary.
  struct Sides {
    bool front, back;
  };
  std::vector<Sides> sides;

  /// Whether a triangle is part of the boundary: in a part that is not solid all proper triangles are.
  [[nodiscard]] bool is_boundary(std::uint32_t triangle) const {
    const std::uint32_t shell = topology.shell[triangle];
    return shell != Topology::kNoShell && (!solid || sides[shell].front != sides[shell].back);
  }
  /// Whether the normal of a solid's boundary triangle points to the interior.
  [[nodiscard]] bool is_inward(std::uint32_t triangle) const {
    return solid && is_boundary(triangle) && sides[topology.shell[triangle]].front;
  }
  /// The positions of a triangle's corners.
  [[nodiscard]] std::array<std::uint32_t, 3> corners(std::uint32_t triangle) const {
    return topology.corners(body, triangle);
  }
};

/// `solid`: whether the body is closed and no two of its triangles cross or share an area.
Part make_part(Body body, Topology topology, bool solid);
/// The body with its own topology; solid if it is closed, even if it crosses itself.
Part make_part(Body body);

}  // namespace impinge::solid
