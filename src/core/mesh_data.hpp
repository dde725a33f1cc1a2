// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/shapes.hpp"
#include "impinge/mesh.hpp"

namespace impinge {

/// A mesh's numbers, and what was read off them once. Bounds are over the vertices that triangles use.
struct MeshData {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Box box{};
  Sphere sphere{};                  ///< holds every used vertex for certain
  Vec3 max_abs{};                   ///< largest |x|, |y|, |z|
  int min_exponent = 0;             ///< of the smallest non-zero |coordinate|: floor(log2)
  int min_bit = 0;                  ///< of the lowest bit set in any coordinate: all are multiples of 2^min_bit
  std::uint64_t hash = 0;           ///< of vertices and triangles (docs/hash.md)
  std::uint64_t corners_hash = 0;   ///< the triangles' part of it
  bool has_loose_vertices = false;  ///< some that no triangle has
  Precision precision = Precision::whole;
};

}  // namespace impinge
