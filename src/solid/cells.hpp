// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/contact.hpp"
#include "solid/body.hpp"
#include "solid/topology.hpp"

namespace impinge::solid {

/// Where the open 2-cells of a boundary, cut by another body's boundary, lie in that other body; or-ed bits.
enum Where : std::uint8_t {
  kInside = 1,     ///< in its interior (winding number not 0)
  kOutside = 2,    ///< in its exterior
  kSameSide = 4,   ///< in its boundary, both interiors on one side; of a body that is not solid: in its triangles
  kOtherSide = 8,  ///< in its boundary, the interiors on either side
  kNear = 16,      ///< within the tolerance of its boundary (with a tolerance: in place of the two above)
};

/// What a body is to the verdicts.
struct Part {
  Body body;
  Topology topology;
  bool solid = false;
  /// Per shell of a solid: whether the side that its triangles' normals point to, and the other one, are interior.
  /// Where both or neither are, the shell is no part of the boundary: it is left out of all that follows.
  struct Sides {
    bool front, back;
  };
  std::vector<Sides> sides;
};

/// Which bits occur among the cells of a (cut by b) and of b (cut by a).
struct Cells {
  std::uint8_t a = 0, b = 0;
};

/// Exactly, by rational numbers where points must be constructed. `contacts` are all pairs of triangles that share a
/// point, of whichever kind. The inside and outside of a part that is not solid are not looked for: the other's cells
/// are then only in its triangles (kSameSide) or kOutside. Stops early, with what was found until then, once
/// `enough(cells)`.
Cells cells_of(const Part& a, const Part& b, std::span<const exact::Contact> contacts, bool (*enough)(const Cells&));

}  // namespace impinge::solid
