// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/vec3.hpp"
#include "exact/pair_signs.hpp"

namespace impinge::exact {

/// Eight pairs of triangles, a lane each. Row 3 i + axis holds vertex i, numbered as in PairSigns.
struct PairBlock {
  static constexpr std::size_t kLanes = 8;

  alignas(64) std::int64_t offsets[6][kLanes];    ///< of the vertices, in numbers of their meshes' arrays
  alignas(64) double rows[18][kLanes];            ///< in the world
  alignas(64) std::int64_t integers[18][kLanes];  ///< in lanes whose signs say that they fit
  alignas(64) PairSigns signs[kLanes];
};

/// Fills the rows with the world vertices of contract 1.1.
void place(PairBlock& block, const Vec3* vertices_a, const Pose& pose_a, const Vec3* vertices_b, const Pose& pose_b);

/// Fills the signs from the rows, by floating point in double and then in twice the precision, and the integers where
/// they may be needed. Triangles whose boxes are apart are called beyond each other's plane.
void compute_signs(PairBlock& block);

}  // namespace impinge::exact
