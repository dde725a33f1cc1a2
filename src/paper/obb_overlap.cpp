// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/obb_overlap.hpp"

#include "core/pose.hpp"

namespace impinge::paper {
// A shared point is R_A x + t_A + e = R_B y + t_B + f with x and y in the two boxes and e, f the rounding of world
// vertices (contract 1.1): x = M y + t + R_A⁻¹(f - e), M = R_A⁻¹ R_B, t = R_A⁻¹(t_B - t_A). With u = 2^-53, S the sum
// of both meshes' and both translations' magnitudes (1-norms), and all matrices within 1e-6 of rotations, at most
//    8 u S  in R_A⁻¹(f - e): 4.01 u a coordinate of |R||x| + |t|, times sqrt 3,
//   24 u S  in M and t: adjugate, product, difference,
//   16 u S  in moving a box of B to A's frame: two products and sums of three terms,
//   24 u S  for axes that are orthonormal only to 24 u (they scale a half extent or a distance, each below S),
//   64 u S  in the test: dot products of three terms, sums of six, of lengths below S,
// 136 u S in all, and 2^-45 S = 256 u S is taken. The test takes M for a rotation: MᵀM differs from I by at most 6 rho,
// rho the sum of both defects, and that shifts a projection of B's box by at most 6 rho times three half extents of B;
// 32 rho times B's diameter is taken.
RelativePose::RelativePose(const Pose& pose_a, const MeshData& mesh_a, const Pose& pose_b, const MeshData& mesh_b) {
  const Mat3 inverse_a = inverse(to_mat3(pose_a.R));
  M = inverse_a * to_mat3(pose_b.R);
  const Vec3 ta{pose_a.t[0], pose_a.t[1], pose_a.t[2]}, tb{pose_b.t[0], pose_b.t[1], pose_b.t[2]};
  t = inverse_a * (tb - ta);
  const double magnitude = sum(mesh_a.max_abs) + sum(mesh_b.max_abs) + sum(abs(ta)) + sum(abs(tb));
  const double defect = orthogonality_defect(pose_a) + orthogonality_defect(pose_b);
  margin = 0x1p-45 * magnitude + 32 * defect * sum(mesh_b.box.hi - mesh_b.box.lo);
}

Obb RelativePose::moved(const Obb& b) const {
  return {M * b.center + t, {M * b.axes[0], M * b.axes[1], M * b.axes[2]}, b.half};
}

bool may_overlap(const Obb& a, const Obb& b, double margin) {
  // Everything in the frame of a: T is b's centre, D's columns are b's axes.
  const Vec3 T = a.axes * (b.center - a.center);
  const double t[3] = {T.x, T.y, T.z};
  const double ha[3] = {a.half.x, a.half.y, a.half.z}, hb[3] = {b.half.x, b.half.y, b.half.z};
  double D[3][3], F[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      D[i][j] = dot(a.axes[i], b.axes[j]);
      F[i][j] = std::abs(D[i][j]);
    }
    if (std::abs(t[i]) > ha[i] + (F[i][0] * hb[0] + F[i][1] * hb[1] + F[i][2] * hb[2]) + margin) return false;
  }
  for (int j = 0; j < 3; ++j) {
    const double distance = std::abs(t[0] * D[0][j] + t[1] * D[1][j] + t[2] * D[2][j]);
    if (distance > hb[j] + (F[0][j] * ha[0] + F[1][j] * ha[1] + F[2][j] * ha[2]) + margin) return false;
  }
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double distance = std::abs(t[i2] * D[i1][j] - t[i1] * D[i2][j]);
      const double reach = (ha[i1] * F[i2][j] + ha[i2] * F[i1][j]) + (hb[j1] * F[i][j2] + hb[j2] * F[i][j1]);
      if (distance > reach + margin) return false;
    }
  }
  return true;
}

bool may_reach(const Obb& box, const Pose& pose, const Vec3& rounding, const Box& region) {
  const Mat3 R = to_mat3(pose.R);
  const Vec3 center = R * box.center + Vec3{pose.t[0], pose.t[1], pose.t[2]};
  Vec3 reach = rounding;  // of the world vertices, and to spare for the lines here (see rounding_radius)
  for (int i = 0; i < 3; ++i) reach = reach + component(box.half, i) * abs(R * box.axes[i]);
  reach = (1 + 0x1p-48) * reach;
  return overlap({center - reach, center + reach}, region);
}

}  // namespace impinge::paper
