// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/mesh_data.hpp"
#include "core/shapes.hpp"
#include "hierarchy/placed_tree.hpp"

namespace impinge::solid {

/// A placed mesh with its world vertices (contract 1.1), made once: what verdicts, measures and regions work on. Copies
/// share the vertices.
struct Body {
  hierarchy::PlacedTree placed;
  std::shared_ptr<const std::vector<Vec3>> vertices;
  std::span<const Vec3> world;  ///< the same, per mesh vertex
  Box box;                      ///< of the world vertices that triangles use, exactly; empty without triangles

  [[nodiscard]] std::size_t size() const { return placed.mesh->triangles.size(); }
  [[nodiscard]] Triangle triangle(std::uint32_t i) const {
    const auto& [a, b, c] = placed.mesh->triangles[i];
    return {world[a], world[b], world[c]};
  }
};

Body make_body(const hierarchy::PlacedTree& placed);

}  // namespace impinge::solid
