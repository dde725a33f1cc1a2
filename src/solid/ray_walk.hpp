// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>

#include "core/vec3.hpp"
#include "hierarchy/placed_tree.hpp"

namespace impinge::solid {

/// A triangle on a ray's way: its world vertices and its number in the mesh.
using Visit = std::function<void(const Triangle&, std::uint32_t)>;

/// Visits every triangle that the ray from `start` along +x may meet, at most once each: all of those that share a
/// point with the ray from any point within 2^-51 of `start`, relatively and per coordinate, and perhaps others.
void walk_ray(const hierarchy::PlacedTree& body, const Vec3& start, const Visit& visit);

}  // namespace impinge::solid
