// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/rational.hpp"
#include "hierarchy/placed_tree.hpp"

namespace impinge::solid {

/// How often the body's surface winds around a point, exactly on the world vertices; nothing if the point lies on a
/// triangle. Defined for every closed body, crossing itself or not; for others it counts the signed crossings of a ray
/// along +x. A ray from p runs infinitesimally beside p, at (p.y + e, p.z + e²), so that it meets no vertex and no
/// edge: ties are broken by rule (Edelsbrunner and Mücke, "Simulation of Simplicity", 1990). The point must be in the
/// exact domain.
std::optional<int> winding_number(const hierarchy::PlacedTree& body, const Vec3& point);
/// The same for a point whose coordinates are rational numbers.
std::optional<int> winding_number(const hierarchy::PlacedTree& body, const exact::RationalPoint& point);

/// What is around a point that may lie on the surface.
struct Around {
  int beside;  ///< the winding number of p + (e³, e, e²), which no triangle holds; of p itself where none holds p
  std::vector<std::uint32_t> holders;  ///< the triangles that p lies on, closed and degenerate ones included, unsorted
};
Around around(const hierarchy::PlacedTree& body, const Vec3& point);
Around around(const hierarchy::PlacedTree& body, const exact::RationalPoint& point);

/// To which side of the plane of a proper triangle that holds p the point p + (e³, e, e²) lies: +1 if it is the one
/// that the normal points to, -1 the other one.
int side_beside(const Triangle& triangle);

}  // namespace impinge::solid
