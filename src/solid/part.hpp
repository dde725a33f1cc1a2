// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "solid/body.hpp"
#include "solid/topology.hpp"

namespace impinge::solid {

/// A body with what its triangles are to each other: vertices in common, open edges, and shells with their sides.
struct Part {
  Body body;
  Topology topology;
  Fans fans;
  bool solid = false;
  /// Per shell of a solid: whether the side that its triangles' normals point to, and the other one, are interior.
  /// Where both or neither are, the shell is no part of the boundary: it is left out of all that follows.
  struct Sides {
    bool front, back;
  };
  std::vector<Sides> sides;

  /// Whether a triangle is part of the boundary: all proper ones of a part that is not solid are.
  [[nodiscard]] bool is_boundary(std::uint32_t triangle) const {
    const std::uint32_t shell = topology.shell[triangle];
    return shell != Topology::kNoShell && (!solid || sides[shell].front != sides[shell].back);
  }
};

/// `solid`: closed, and no two of its triangles cross or share an area.
Part make_part(Body body, Topology topology, bool solid);

}  // namespace impinge::solid
