// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/rational.hpp"
#include "hierarchy/placed_tree.hpp"

namespace impinge::solid {

/// The winding number of the body's surface around a point, exact on the world vertices; nothing if the point lies on a
/// triangle. It is defined for every closed body, even one that crosses itself; for others it is the number of signed
/// crossings of a ray along +x. The ray from p runs infinitesimally beside p, at (p.y + e, p.z + e²), so that it meets
/// no vertex and no edge: ties are broken by rule (Edelsbrunner and Mücke, "Simulation of Simplicity", 1990). The point
/// must be in range (contract 1.3).
std::optional<int> winding_number(const hierarchy::PlacedTree& body, const Vec3& point);

/// The surface around a point that may lie on it.
struct Around {
  int beside;  ///< the winding number of p + (e³, e, e²), which is on no triangle; of p itself if p is on none
  std::vector<std::uint32_t> holders;  ///< the closed triangles, also degenerate ones, on which p lies; unsorted
};
Around around(const hierarchy::PlacedTree& body, const Vec3& point);
Around around(const hierarchy::PlacedTree& body, const exact::RationalPoint& point);

/// The same, triangle by triangle: how the ray from p + (e³, e, e²) along +x crosses each.
struct Crossings {
  struct Crossing {
    std::uint32_t triangle;
    int way;  ///< +1 out of its front, -1 into it
  };
  std::vector<Crossing> crossings;
  std::vector<std::uint32_t> holders;
};
Crossings crossings_around(const hierarchy::PlacedTree& body, const Vec3& point);

/// On which side of a proper triangle on which p lies the point p + (e³, e, e²) is: +1 where the normal points to, -1
/// on the other side.
int side_beside(const Triangle& triangle);

}  // namespace impinge::solid
