// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/tree_relation.hpp"

#include <cmath>

#include "core/pose.hpp"

namespace impinge::hierarchy {
// A shared point is R_A x + t_A + e = R_B y + t_B + f with x and y on the two meshes and e, f the rounding of world
// vertices (contract 1.1): x = M y + t + R_A⁻¹(f - e), M = R_A⁻¹ R_B, t = R_A⁻¹(t_B - t_A). With u = 2^-53, S the sum
// of both meshes' and both translations' magnitudes (1-norms), and all matrices within 1e-6 of rotations, at most
//    8 u S  in R_A⁻¹(f - e): 4.01 u a coordinate of |R||x| + |t|, times sqrt 3,
//   24 u S  in M and t: adjugate, product, difference,
//   16 u S  in what users of the relation do with it in double: a product M o, two sums, a product with axes,
// 48 u S in all, and 2^-47 S = 64 u S is taken. Powers of two scale without rounding; what they push below 2^-1022 in
// units of the larger mesh's extent is far below u S. MᵀM differs from I by at most 6 times the sum of both defects.
TreeRelation relate(const MeshData& mesh_a, const Pose& pose_a, int unit_a, const MeshData& mesh_b, const Pose& pose_b,
                    int unit_b) {
  const Mat3 inverse_a = inverse(to_mat3(pose_a.R));
  const Mat3 M = inverse_a * to_mat3(pose_b.R);
  const Vec3 ta{pose_a.t[0], pose_a.t[1], pose_a.t[2]}, tb{pose_b.t[0], pose_b.t[1], pose_b.t[2]};
  const Vec3 t = inverse_a * (tb - ta);
  const double magnitude = sum(mesh_a.max_abs) + sum(mesh_b.max_abs) + sum(abs(ta)) + sum(abs(tb));
  const double per_unit = std::ldexp(1.0, -unit_a);  // a double, as the exponent is at least -1000 and at most 1026
  const auto in_unit = [per_unit](double x) { return per_unit * x; };
  TreeRelation relation{};
  relation.scale = std::ldexp(1.0, unit_b - unit_a);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      relation.rows[i][k] = component(M[i], k);
      relation.scaled_columns[k][i] = relation.scale * component(M[i], k);
    }
    relation.t[i] = in_unit(component(t, i));
  }
  relation.error = in_unit(0x1p-47 * magnitude);
  relation.defect = 6 * (orthogonality_defect(pose_a) + orthogonality_defect(pose_b)) + 0x1p-50;
  return relation;
}

}  // namespace impinge::hierarchy
