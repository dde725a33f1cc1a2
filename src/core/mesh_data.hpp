// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/shapes.hpp"
#include "impinge/mesh.hpp"

namespace impinge {

/// What placing a mesh reads, in 14 doubles side by side: bounds over the vertices that triangles use.
struct MeshBounds {
  Box box{};
  Sphere sphere{};         ///< holds every used vertex for certain
  Vec3 max_abs{};          ///< largest |x|, |y|, |z|
  double least_entry = 0;  ///< of a pose's R, beside 0: with less, world coordinates may be no multiples of 2^-358
};
static_assert(sizeof(MeshBounds) == 14 * sizeof(double) && sizeof(Pose) == 12 * sizeof(double));

/// A mesh's numbers, and what was read off them once.
struct MeshData : MeshBounds {
  using Corners = std::array<std::uint32_t, 3>;

  std::vector<Vec3> vertices;
  std::span<const Corners> triangles;                              ///< those of `shared_triangles`
  std::shared_ptr<const std::vector<Corners>> shared_triangles{};  ///< by all meshes deformed from each other
  int min_exponent = 0;             ///< of the smallest non-zero |coordinate|: floor(log2)
  int min_bit = 0;                  ///< of the lowest bit set in any coordinate: all are multiples of 2^min_bit
  std::uint64_t hash = 0;           ///< of vertices and triangles (docs/hash.md)
  std::uint64_t corners_hash = 0;   ///< the triangles' part of it
  bool has_loose_vertices = false;  ///< some that no triangle has
  Precision precision = Precision::whole;

  void set_triangles(std::vector<Corners> list) {
    shared_triangles = std::make_shared<const std::vector<Corners>>(std::move(list));
    triangles = *shared_triangles;
  }
};

}  // namespace impinge
