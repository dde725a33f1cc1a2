// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/relation.hpp"

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

}  // namespace impinge::gpu
