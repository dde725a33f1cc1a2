// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

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

}  // namespace impinge::solid
