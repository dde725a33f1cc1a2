// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/relation.hpp"

#include <algorithm>
#include <cmath>

#include "hierarchy/round_up.hpp"

namespace impinge::gpu {
namespace {

/// Trees whose boxes meet are nearer than this to each other, in A's unit, and none reaches farther.
constexpr double kFar = 64;

void part(double x, float& hi, float& lo) {
  hi = static_cast<float>(x);
  lo = static_cast<float>(x - double{hi});
}

}  // namespace

// From A's root: M (scale (base_b + y)) + t - base_a = M (scale y) + t', t' = M (scale base_b) + t - base_a, whose
// rounding is among what TreeRelation::error grants its users. The device adds up t', an origin of A's and M times one
// of B's to within 2^-37 of the sum of their magnitudes (shaders/frames.glsl), in which the second parts' rounding is.
std::optional<DeviceRelation> device_relation(const hierarchy::TreeRelation& relation, const TreeExtent& a,
                                              const TreeExtent& b) {
  DeviceRelation made{};
  const double base_a[3] = {a.base.x, a.base.y, a.base.z}, base_b[3] = {b.base.x, b.base.y, b.base.z};
  double magnitude = 0;
  for (int i = 0; i < 3; ++i) {
    double t = relation.t[i] - base_a[i];
    for (int k = 0; k < 3; ++k) {
      t += relation.scaled_columns[k][i] * base_b[k];
      part(relation.rows[i][k], made.m_hi[3 * i + k], made.m_lo[3 * i + k]);
    }
    if (!(std::abs(t) < kFar)) return std::nullopt;
    part(t, made.t_hi[i], made.t_lo[i]);
    magnitude = std::max(magnitude, std::abs(t));
  }
  const double reach_b = relation.scale * b.reach;
  if (!(a.reach < kFar && reach_b < kFar && relation.error < kFar)) return std::nullopt;
  made.scale = static_cast<float>(relation.scale);
  made.error = hierarchy::round_up(relation.error + 0x1p-37 * (magnitude + a.reach + 3.01 * reach_b));
  made.defect = hierarchy::round_up(relation.defect);
  return made;
}

// With E the largest |R||x| + |t|, at most 1 here, and u = 2^-53, contract 1.1's numbers are within 4.01 u E of the
// exact R x + t (core/pose.hpp), the device's, which rounds in any direction, within twice that: 12.1 u from each
// other, and 2^-49 is 16 u. What is taken for zero below 2^-1022, here or there, is at most that times |x| < 2E or a
// row of the scaled R, or itself: with E from 2^-400 to 2^400 before it is scaled, below 2^-600.
DevicePoses device_poses(const Pose& pose_a, const MeshData& a, const Pose& pose_b, const MeshData& b) {
  constexpr int kMostExponent = 400;
  const double radius = std::max(max_component(rounding_radius(pose_a, a)), max_component(rounding_radius(pose_b, b)));
  int exponent = 0;
  std::frexp(radius * 0x1p49, &exponent);
  DevicePoses made{};
  made.is_usable = radius > 0 && std::abs(exponent) < kMostExponent ? 1 : 0;
  if (made.is_usable == 0) return made;
  const double scale = std::ldexp(1.0, -exponent);
  const auto place = [&](const Pose& pose, DevicePose& to) {
    for (std::size_t i = 0; i < 9; ++i) to.R[i] = scale * pose.R[i];
    for (std::size_t i = 0; i < 3; ++i) to.t[i] = scale * pose.t[i];
  };
  place(pose_a, made.a), place(pose_b, made.b);
  return made;
}

}  // namespace impinge::gpu
