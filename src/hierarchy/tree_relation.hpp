// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/mesh_data.hpp"
#include "impinge/mesh.hpp"

namespace impinge::hierarchy {

/// How tree B lies in tree A's space: the map y -> M (scale y) + t takes coordinates of B's mesh, in B's unit, to A's
/// mesh and unit. Made once a query and pair of objects.
struct TreeRelation {
  alignas(32) double rows[3][4];            ///< M; the fourth lane is 0
  alignas(32) double scaled_columns[3][4];  ///< scale M, by columns
  alignas(32) double t[4];                  ///< the fourth is 0
  double scale;                             ///< B's unit in A's, a power of two and at most 1
  double error;   ///< in A's unit: how far the map may take a shared world point from where it lies in A
  double defect;  ///< at least max|MᵀM - I|
};

/// `unit_a` and `unit_b` are the trees' unit exponents, unit_a >= unit_b.
TreeRelation relate(const MeshData& mesh_a, const Pose& pose_a, int unit_a, const MeshData& mesh_b, const Pose& pose_b,
                    int unit_b);

}  // namespace impinge::hierarchy
