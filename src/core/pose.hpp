// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "core/mesh_data.hpp"
#include "core/vec3.hpp"

namespace impinge {

/// Contract 1.1, applied to each vertex that `indices` names. `out` has as many elements as `indices`.
void pose_vertices(const Pose& pose, std::span<const Vec3> vertices, std::span<const std::uint32_t> indices, Vec3* out);

/// The same for every vertex, in place.
void pose_all_vertices(const Pose& pose, std::span<Vec3> vertices);

/// max|RᵀR - I|, up to rounding.
double orthogonality_defect(const Pose& pose);

/// Per axis, at least the distance by which a world vertex of the mesh may be off the exact R x + t. With u = 2^-53 and
/// S = |R||x| + |t| the three products and three sums are off by at most 4.01 u S; returned is 16 u S, so that bounds
/// which pose a centre and an extent in floating point themselves may rely on it too; and 2^-1000, far above what
/// products may lose to underflow.
Vec3 rounding_radius(const Pose& pose, const MeshData& mesh);

/// Whether every world vertex is below 2^300 and a multiple of 2^-358 (contract 1.3): from the stored exponents where
/// they suffice, else by posing every vertex.
bool in_exact_domain(const Pose& pose, const MeshData& mesh);
/// The same for one world point, which may hold anything.
bool in_exact_domain(const Vec3& point);

/// Whether every world vertex is below 2^300, and the mesh's largest coordinate is 0 or at least 2^-300.
bool in_range(const Pose& pose, const MeshData& mesh);
bool in_range(const Vec3& point);

}  // namespace impinge
