// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/mesh_data.hpp"
#include "core/vec3.hpp"

namespace impinge::paper {

/// {center + axesᵀ u : |u| <= half}, in the mesh's frame; the rows of `axes` are orthonormal to within 24 eps.
struct Obb {
  Vec3 center{};
  Mat3 axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 half{};
};

/// The paper's equations 2 to 5: axes along the eigenvectors of the covariance of the triangles' vertices, borders
/// where their projections end. Holds every vertex for certain. `triangles` is not empty.
Obb fit_obb(const MeshData& mesh, std::span<const std::uint32_t> triangles);

}  // namespace impinge::paper
