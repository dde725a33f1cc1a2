// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Compiled once an instruction set: included after hwy/foreach_target.h, by that header's rules.
#if defined(IMPINGE_FRAME_RELATION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IMPINGE_FRAME_RELATION_INL
#undef IMPINGE_FRAME_RELATION_INL
#else
#define IMPINGE_FRAME_RELATION_INL
#endif

#include <hwy/highway.h>

#include "hierarchy/frame.hpp"
#include "hierarchy/tree_relation.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// How one frame of B lies in one of A: x = C (scale y) + c, in single precision.
struct FrameRelation {
  float columns[3][4];  ///< columns[k][i] is C's entry in row i, column k; the fourth lane is 0
  float c[4];
};

/// C = F_A M F_Bᵀ and c = F_A (M scale o_B + t - o_A), each computed in double and rounded once.
HWY_INLINE FrameRelation relate_frames(const Frame& a, const Frame& b, const TreeRelation& relation) {
  const hn::CappedTag<double, 4> d;
  const hn::Rebind<float, decltype(d)> df;
  using V = hn::Vec<decltype(d)>;
  constexpr std::size_t kParts = 4 / hn::MaxLanes(hn::CappedTag<double, 4>());  // vectors to four lanes
  const std::size_t lanes = hn::Lanes(d);
  alignas(32) double product[3][4], offset[4];  // M F_Bᵀ; M scale o_B + t - o_A
  for (std::size_t part = 0, lane = 0; part < kParts; ++part, lane += lanes) {
    const auto promoted = [&](const float* from) HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(df, from + lane)); };
    const V b0 = promoted(b.axes[0]), b1 = promoted(b.axes[1]), b2 = promoted(b.axes[2]);
    for (int i = 0; i < 3; ++i) {
      const double* m = relation.rows[i];
      const V sum = hn::MulAdd(hn::Set(d, m[0]), b0, hn::MulAdd(hn::Set(d, m[1]), b1, hn::Mul(hn::Set(d, m[2]), b2)));
      hn::Store(sum, d, product[i] + lane);
    }
    V sum = hn::Sub(hn::Load(d, relation.t + lane), hn::LoadU(d, a.origin + lane));
    for (int l = 0; l < 3; ++l)
      sum = hn::MulAdd(hn::Load(d, relation.scaled_columns[l] + lane), hn::Set(d, b.origin[l]), sum);
    hn::Store(sum, d, offset + lane);
  }
  FrameRelation result;
  for (std::size_t part = 0, lane = 0; part < kParts; ++part, lane += lanes) {
    const auto promoted = [&](const float* from) HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(df, from + lane)); };
    const V a0 = promoted(a.axes[0]), a1 = promoted(a.axes[1]), a2 = promoted(a.axes[2]);
    const auto combined = [&](double x, double y, double z) HWY_ATTR {
      return hn::MulAdd(a0, hn::Set(d, x), hn::MulAdd(a1, hn::Set(d, y), hn::Mul(a2, hn::Set(d, z))));
    };
    for (int k = 0; k < 3; ++k)
      hn::StoreU(hn::DemoteTo(df, combined(product[0][k], product[1][k], product[2][k])), df, result.columns[k] + lane);
    // Frames so far apart never overlap; clamped, no product with C overflows.
    const V far = hn::Set(d, 1e20);
    const V c = hn::Max(hn::Neg(far), hn::Min(far, combined(offset[0], offset[1], offset[2])));
    hn::StoreU(hn::DemoteTo(df, c), df, result.c + lane);
  }
  return result;
}

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // IMPINGE_FRAME_RELATION_INL
