// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "measure/lower_bounds.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "measure/lower_bounds.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/mask_bits-inl.hpp"
#include "hierarchy/leaf_against_box-inl.hpp"
#include "hierarchy/wide_boxes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::measure::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using hierarchy::kWidth;
using hierarchy::TreeRef;
using hierarchy::TreeRelation;
using hierarchy::WideLeaf;
using hierarchy::HWY_NAMESPACE::Boxes;
using hierarchy::HWY_NAMESPACE::BoxSide;
using hierarchy::HWY_NAMESPACE::FrameRelation;
using hierarchy::HWY_NAMESPACE::TriangleLanes;
using impinge::HWY_NAMESPACE::mask_bits;

/// A gap is not taken for more than this: its square must not overflow.
constexpr float kFar = 1e18f;

// What a length in a frame is of the length in the world, at least. Positions are right to within the slack of the maps
// (hierarchy/wide_boxes-inl.hpp); what is left are linear maps close to isometries, as parts of the length:
//   1.5 * 2^-20 for the frame (|F| <= 1 + 1.5 max|F Fᵀ - I|), 1.5 defects of a pose, of which the relation's defect
//   holds six times the sum; and, for B's frame, CᵀC in place of the identity: 3 defect + 6.5 * 2^-20;
//   and six roundings to float. In all less than 3.25 defect + 9 * 2^-20.
HWY_INLINE float shrink_of(const TreeRelation& relation) {
  return 1 - (0x1p-16f + 4 * static_cast<float>(relation.defect));
}

/// Greater than the limit's square for certain, in lengths that are still to be multiplied by `shrink`.
HWY_INLINE float square_of(float limit, float shrink) {
  if (!(limit < kFar)) return std::numeric_limits<float>::max();
  const float most = limit / shrink * (1 + 0x1p-20f);
  return std::max(most * most, 0x1p-120f);
}

template <class D, class V>
HWY_INLINE V gap(D d, V distance, V reach) {
  return hn::Min(hn::Max(hn::Sub(distance, reach), hn::Zero(d)), hn::Set(d, kFar));
}

HWY_ATTR void bound_boxes(const TreeRef& ref_a, const TreeRef& ref_b, bool of_both, const TreeRelation& trees,
                          float limit, BoxBounds& bounds) {
  const FrameRelation relation = hierarchy::HWY_NAMESPACE::relate_frames(frame_of(ref_a), frame_of(ref_b), trees);
  BoxSide a, b;
  Boxes own_a, own_b;
  using hierarchy::HWY_NAMESPACE::Opening;
  const auto opening =
      of_both ? Opening{!ref_a.is_leaf(), !ref_b.is_leaf()} : hierarchy::HWY_NAMESPACE::opening_of(ref_a, ref_b, trees);
  hierarchy::HWY_NAMESPACE::open_both(ref_a, ref_b, opening, relation, trees, own_a, own_b, a, b);
  bounds.bits = 0, bounds.opens_a = opening.a, bounds.opens_b = opening.b;
  const BoxSide &one = bounds.opens_b ? a : b, &lanes = bounds.opens_b ? b : a;
  const unsigned filled = (1u << lanes.size) - 1;
  const float shrink = shrink_of(trees), most = square_of(limit, shrink);
  const hn::CappedTag<float, kWidth> d;
  for (int i = 0; i < one.size; ++i) {
    unsigned bits = 0;
    for (std::size_t lane = 0; lane < kWidth; lane += hn::Lanes(d)) {
      auto own = hn::Zero(d), other = hn::Zero(d);
      for (int axis = 0; axis < 3; ++axis) {
        const auto x =
            gap(d, hn::Abs(hn::Sub(hn::Load(d, lanes.mapped.center[axis] + lane), hn::Set(d, one.center[axis][i]))),
                hn::Add(hn::Load(d, lanes.mapped.half[axis] + lane), hn::Set(d, one.half[axis][i])));
        const auto y =
            gap(d, hn::Abs(hn::Sub(hn::LoadU(d, lanes.center[axis] + lane), hn::Set(d, one.mapped.center[axis][i]))),
                hn::Add(hn::LoadU(d, lanes.half[axis] + lane), hn::Set(d, one.mapped.half[axis][i])));
        own = hn::MulAdd(x, x, own), other = hn::MulAdd(y, y, other);
      }
      const auto square = hn::Max(own, other);
      hn::Store(hn::Mul(hn::Sqrt(square), hn::Set(d, shrink)), d, bounds.lower[i] + lane);
      bits |= mask_bits(d, hn::Le(square, hn::Set(d, most))) << lane;
    }
    bounds.bits |= std::uint64_t{bits & filled} << (kWidth * i);
  }
  if (!hierarchy::HWY_NAMESPACE::is_leaf_against_smaller(ref_a, ref_b, trees)) return;
  // The leaf's one box says little: its triangles are compared with the boxes of the other's children.
  const WideLeaf& leaf = ref_a.is_leaf() ? ref_a.leaf() : ref_b.leaf();
  const hierarchy::HWY_NAMESPACE::LeafAgainstNode lies(
      leaf, ref_a.is_leaf() ? 1 : static_cast<float>(trees.scale), ref_a.is_leaf(), relation, lanes,
      hierarchy::HWY_NAMESPACE::slack_of(relation, trees, frame_of(ref_a).radius, frame_of(ref_b).radius));
  float squares[kWidth];
  std::fill_n(squares, kWidth, std::numeric_limits<float>::max());
  for (std::size_t first = 0; first < leaf.count; first += hn::Lanes(TriangleLanes())) {
    const hierarchy::HWY_NAMESPACE::TrianglesAgainstBoxes triangles(lies, first);
    for (std::uint64_t left = bounds.bits; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      squares[lane] = std::min(squares[lane], triangles.square_gap(lane));
    }
  }
  for (std::uint64_t left = bounds.bits; left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    bounds.lower[0][lane] = std::max(bounds.lower[0][lane], shrink * std::sqrt(squares[lane]));
    if (squares[lane] > most) bounds.bits &= ~(std::uint64_t{1} << lane);
  }
}

/// A leaf's triangles in A's frame, the x of all first corners first, and their boxes.
struct Triangles {
  alignas(64) float corner[9][kMostInLeaf];
  alignas(64) float lo[3][kMostInLeaf];
  alignas(64) float hi[3][kMostInLeaf];
};

/// Corners come from `coordinate(corner, axis, lane)`.
template <class Coordinate>
HWY_INLINE void lay_out(std::size_t stride, Triangles& triangles, const Coordinate& coordinate) {
  const TriangleLanes d;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t lane = 0; lane < stride; lane += hn::Lanes(d)) {
      const auto x = coordinate(0, axis, lane), y = coordinate(1, axis, lane), z = coordinate(2, axis, lane);
      hn::Store(x, d, triangles.corner[axis] + lane);
      hn::Store(y, d, triangles.corner[3 + axis] + lane);
      hn::Store(z, d, triangles.corner[6 + axis] + lane);
      hn::Store(hn::Min(x, hn::Min(y, z)), d, triangles.lo[axis] + lane);
      hn::Store(hn::Max(x, hn::Max(y, z)), d, triangles.hi[axis] + lane);
    }
  }
}

HWY_INLINE void lay_out_own(const WideLeaf& leaf, Triangles& triangles) {
  const TriangleLanes d;
  lay_out(leaf.stride, triangles, [&](int corner, int axis, std::size_t lane) HWY_ATTR {
    return hn::Load(d, leaf.row(3 * corner + axis) + lane);
  });
}

HWY_INLINE void lay_out_mapped(const WideLeaf& leaf, const FrameRelation& f, float scale, Triangles& triangles) {
  const TriangleLanes d;
  lay_out(leaf.stride, triangles, [&](int corner, int axis, std::size_t lane) HWY_ATTR {
    const auto term = [&](int k, auto sum) HWY_ATTR {
      return hn::MulAdd(hn::Set(d, scale * f.columns[k][axis]), hn::Load(d, leaf.row(3 * corner + k) + lane), sum);
    };
    return term(0, term(1, term(2, hn::Set(d, f.c[axis]))));
  });
}

/// The gap between triangle `i` of A and some of B along the lines between their middles, below 0 where there is none.
HWY_INLINE hn::Vec<TriangleLanes> slab_gap(const Triangles& a, std::uint32_t i, const Triangles& b,
                                           std::uint32_t lane) {
  const TriangleLanes d;
  using V = hn::Vec<TriangleLanes>;
  V n[3];
  auto square = hn::Set(d, 1e-30f);  // where the middles are the same
  for (int axis = 0; axis < 3; ++axis) {
    const auto sum = hn::Add(hn::Load(d, b.corner[axis] + lane),
                             hn::Add(hn::Load(d, b.corner[3 + axis] + lane), hn::Load(d, b.corner[6 + axis] + lane)));
    n[axis] = hn::Sub(sum, hn::Set(d, a.corner[axis][i] + a.corner[3 + axis][i] + a.corner[6 + axis][i]));
    square = hn::MulAdd(n[axis], n[axis], square);
  }
  const auto of_a = [&](std::size_t c) HWY_ATTR {
    return hn::MulAdd(
        n[0], hn::Set(d, a.corner[3 * c][i]),
        hn::MulAdd(n[1], hn::Set(d, a.corner[3 * c + 1][i]), hn::Mul(n[2], hn::Set(d, a.corner[3 * c + 2][i]))));
  };
  const auto of_b = [&](std::size_t c) HWY_ATTR {
    return hn::MulAdd(n[0], hn::Load(d, b.corner[3 * c] + lane),
                      hn::MulAdd(n[1], hn::Load(d, b.corner[3 * c + 1] + lane),
                                 hn::Mul(n[2], hn::Load(d, b.corner[3 * c + 2] + lane))));
  };
  const auto greatest = hn::Max(of_a(0), hn::Max(of_a(1), of_a(2)));
  const auto least = hn::Min(of_b(0), hn::Min(of_b(1), of_b(2)));
  return hn::Div(hn::Sub(least, greatest), hn::Sqrt(square));
}

// How far, in A's frame, triangles of two leaves may be from where the boxes have them, together: what either leaf
// says of its rounding, B's turned by C; the relation's error; F_B⁻¹ - F_Bᵀ, which the leaf knows; and roundings to
// float of C, c, products and sums, as derived in partition/sweep.cpp.
HWY_INLINE float slack_of(const WideLeaf& a, const WideLeaf& b, const FrameRelation& f, const TreeRelation& trees) {
  const auto scale = static_cast<float>(trees.scale), rounding = static_cast<float>(trees.error);
  const float far = std::max({std::abs(f.c[0]), std::abs(f.c[1]), std::abs(f.c[2])});
  const float error_b =
      scale * (1.8f * b.error + b.inverse_error) + 0x1p-24f * (5 * far + 14 * scale * b.frame.radius) + 2 * rounding;
  return 1.001f * (a.error + rounding + error_b) + 0x1p-22f * (a.frame.radius + far) + 0x1p-100f;
}

// A slab's gap is off by the slack of a coordinate times sqrt 3, in whatever direction; and by the rounding of six dot
// products, of which two count: 3 u of |x|, less than 5.2 u of the largest coordinates each, and little of what
// follows.
HWY_INLINE float slab_slack(const WideLeaf& a, const WideLeaf& b, const FrameRelation& f, const TreeRelation& trees,
                            float slack) {
  const float far = std::max({std::abs(f.c[0]), std::abs(f.c[1]), std::abs(f.c[2])});
  return 1.75f * slack + 0x1p-20f * (a.frame.radius + far + 2 * static_cast<float>(trees.scale) * b.frame.radius);
}

HWY_ATTR void bound_triangles(const WideLeaf& a, const WideLeaf& b, const TreeRelation& trees, float limit,
                              std::vector<NearTriangles>& near) {
  const FrameRelation f = hierarchy::HWY_NAMESPACE::relate_frames(a.frame, b.frame, trees);
  Triangles of_a, of_b;
  lay_out_own(a, of_a);
  lay_out_mapped(b, f, static_cast<float>(trees.scale), of_b);
  const TriangleLanes d;
  const float slack = slack_of(a, b, f, trees), shrink = shrink_of(trees), most = square_of(limit, shrink);
  const float slack_of_slab = slab_slack(a, b, f, trees, slack);
  const bool use_slabs = slack_of_slab < 1e12f;  // no dot product overflows
  near.clear();
  alignas(64) float lower[16];
  for (std::uint32_t i = 0; i < a.count; ++i) {
    for (std::uint32_t lane = 0; lane < b.count; lane += static_cast<std::uint32_t>(hn::Lanes(d))) {
      auto square = hn::Zero(d);
      for (int axis = 0; axis < 3; ++axis) {
        // The analyzer takes it for possible that lay_out_own writes nothing. NOLINTNEXTLINE(clang-analyzer-core.*)
        const auto apart = hn::Max(hn::Sub(hn::Load(d, of_b.lo[axis] + lane), hn::Set(d, of_a.hi[axis][i])),
                                   hn::Sub(hn::Set(d, of_a.lo[axis][i]), hn::Load(d, of_b.hi[axis] + lane)));
        const auto x = gap(d, apart, hn::Set(d, slack));
        square = hn::MulAdd(x, x, square);
      }
      unsigned bits = mask_bits(d, hn::Le(square, hn::Set(d, most)));
      if (b.count - lane < 32) bits &= (1u << (b.count - lane)) - 1;
      if (bits == 0) continue;
      if (use_slabs) {
        const auto x = gap(d, slab_gap(of_a, i, of_b, lane), hn::Set(d, slack_of_slab));
        square = hn::Max(square, hn::Mul(x, x));
        bits &= mask_bits(d, hn::Le(square, hn::Set(d, most)));
      }
      hn::Store(hn::Mul(hn::Sqrt(square), hn::Set(d, shrink)), d, lower);
      for (; bits != 0; bits &= bits - 1) {
        const auto at = static_cast<std::uint32_t>(std::countr_zero(bits));
        near.push_back({double{lower[at]}, static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(lane + at)});
      }
    }
  }
}

}  // namespace impinge::measure::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::measure {

HWY_EXPORT(bound_boxes);
HWY_EXPORT(bound_triangles);

void bound_boxes(const hierarchy::TreeRef& a, const hierarchy::TreeRef& b, bool of_both,
                 const hierarchy::TreeRelation& relation, float limit, BoxBounds& bounds) {
  HWY_DYNAMIC_DISPATCH(bound_boxes)(a, b, of_both, relation, limit, bounds);
}

void bound_triangles(const hierarchy::WideLeaf& a, const hierarchy::WideLeaf& b,
                     const hierarchy::TreeRelation& relation, float limit, std::vector<NearTriangles>& near) {
  HWY_DYNAMIC_DISPATCH(bound_triangles)(a, b, relation, limit, near);
}

}  // namespace impinge::measure
#endif
