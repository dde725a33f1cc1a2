// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/local_frame.hpp"
#include "impinge/clash.hpp"
#include "solid/inner_points.hpp"
#include "solid/triangle_tree.hpp"

namespace impinge::solid {

/// A piece of a body: what verdicts go by.
struct ClassedPiece {
  PartClass part_class = PartClass::surface;
  std::vector<std::array<std::uint32_t, 3>>
      triangles;                         ///< by vertices of the body's mesh, turned; without shells within the material
  std::vector<InnerPoint> inner_points;  ///< in the world, of up to 64 triangles
  double radius = 0;                     ///< the largest of theirs
  double volume = 0;                     ///< of a solid
  /// Of a cracked piece: its winding numbers and its open edges, as segments, in `frame`.
  std::optional<TriangleTree> tree{}, open_edges{};
  LocalFrame frame{};
};

}  // namespace impinge::solid
