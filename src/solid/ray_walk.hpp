// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>

#include "core/vec3.hpp"
#include "hierarchy/placed_tree.hpp"

namespace impinge::solid {

/// Called with the world vertices of a triangle and its index in the mesh.
using Visit = std::function<void(const Triangle&, std::uint32_t)>;

/// Visits each triangle that the ray from `start` along +x may meet once: all triangles that share a point with the ray
/// from any point within 2^-51 of `start`, relatively and per coordinate, and perhaps others.
void walk_ray(const hierarchy::PlacedTree& body, const Vec3& start, const Visit& visit);

}  // namespace impinge::solid
