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
#include "hierarchy/large_leaf-inl.hpp"
#include "hierarchy/wide_boxes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::measure::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using hierarchy::kWidth;
using hierarchy::TreeRef;
using hierarchy::TreeRelation;
using hierarchy::WideLeaf;
using hierarchy::WideNode;
using hierarchy::HWY_NAMESPACE::Boxes;
using hierarchy::HWY_NAMESPACE::BoxSide;
using hierarchy::HWY_NAMESPACE::FrameRelation;
using hierarchy::HWY_NAMESPACE::LargeLeaf;
using impinge::HWY_NAMESPACE::mask_bits;
using TriangleLanes = hn::CappedTag<float, 16>;

/// A gap is not taken for more than this: its square must not overflow.
constexpr float kFar = 1e18f;

// The least ratio of a length in the world to the frame's, and of the frame's to it. Positions are right to within the
// slack of the maps (hierarchy/wide_boxes-inl.hpp); what is left are linear maps close to isometries, as parts of the
// length:
//   1.5 * 2^-20 for the frame (|F| <= 1 + 1.5 max|F Fᵀ - I|), 1.5 defects of a pose, of which the relation's defect
//   holds six times the sum; and, for B's frame, CᵀC in place of the identity: 3 defect + 6.5 * 2^-20;
//   and six roundings to float, with five more of a unit normal. In all less than 3.25 defect + 9 * 2^-20.
// Either way: a length in the world is at least the frame's * shrink, and at most the frame's / shrink.
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

/// A leaf's one box says little beside a node that is much the smaller: its triangles are compared with the boxes of
/// the node's children.
HWY_INLINE void bound_by_triangles(const LargeLeaf& large, const WideNode& node, float shrink, float most,
                                   BoxBounds& bounds) {
  float squares[kWidth];
  large.square_gaps(node, std::sqrt(most), squares);
  bounds.bits = 0;
  for (std::uint32_t lane = 0; lane < node.size; ++lane) {
    bounds.lower[0][lane] = shrink * std::sqrt(squares[lane]);
    if (squares[lane] <= most) bounds.bits |= std::uint64_t{1} << lane;
  }
}

HWY_ATTR void bound_boxes(const TreeRef& ref_a, const TreeRef& ref_b, bool of_both, const TreeRelation& trees,
                          float limit, BoxBounds& bounds) {
  using hierarchy::HWY_NAMESPACE::Opening;
  const auto opening =
      of_both ? Opening{!ref_a.is_leaf(), !ref_b.is_leaf()} : hierarchy::HWY_NAMESPACE::opening_of(ref_a, ref_b, trees);
  bounds.opens_a = opening.a, bounds.opens_b = opening.b;
  const float shrink = shrink_of(trees), most = square_of(limit, shrink);
  if (const auto side = LargeLeaf::side_of(ref_a, ref_b, trees); side != LargeLeaf::Side::none) {
    const bool large_is_a = side == LargeLeaf::Side::a;
    LargeLeaf large;
    large.set((large_is_a ? ref_a : ref_b).leaf(), large_is_a, trees);
    return bound_by_triangles(large, (large_is_a ? ref_b : ref_a).node(), shrink, most, bounds);
  }
  const FrameRelation relation = hierarchy::HWY_NAMESPACE::relate_frames(frame_of(ref_a), frame_of(ref_b), trees);
  BoxSide a, b;
  Boxes own_a, own_b;
  hierarchy::HWY_NAMESPACE::open_both(ref_a, ref_b, opening, relation, trees, own_a, own_b, a, b);
  bounds.bits = 0;
  const BoxSide &one = bounds.opens_b ? a : b, &lanes = bounds.opens_b ? b : a;
  const unsigned filled = (1u << lanes.size) - 1;
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
}

using V = hn::Vec<TriangleLanes>;

/// A leaf's triangles in A's frame, the x of all first corners first; their boxes; and about their unit normals, with
/// the range of the corners along each.
struct Triangles {
  alignas(64) float corner[9][kMostInLeaf];
  alignas(64) float lo[3][kMostInLeaf];
  alignas(64) float hi[3][kMostInLeaf];
  alignas(64) float normal[3][kMostInLeaf];
  alignas(64) float lo_along[kMostInLeaf];
  alignas(64) float hi_along[kMostInLeaf];
};

HWY_INLINE V along(const V* n, const V* x) {
  return hn::MulAdd(n[0], x[0], hn::MulAdd(n[1], x[1], hn::Mul(n[2], x[2])));
}
HWY_INLINE V least(V x, V y, V z) { return hn::Min(x, hn::Min(y, z)); }
HWY_INLINE V greatest(V x, V y, V z) { return hn::Max(x, hn::Max(y, z)); }
/// Not infinite where it is zero, or so short that its products underflow.
HWY_INLINE V reciprocal_length(const V* n) {
  const TriangleLanes d;
  return hn::Div(hn::Set(d, 1.0f), hn::Sqrt(hn::Add(along(n, n), hn::Set(d, 1e-30f))));
}

/// Corners come from `coordinate(corner, axis, lane)`.
template <class Coordinate>
HWY_INLINE void lay_out(std::size_t stride, Triangles& triangles, const Coordinate& coordinate) {
  const TriangleLanes d;
  for (std::size_t lane = 0; lane < stride; lane += hn::Lanes(d)) {
    V corner[9], n[3];
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 3; ++k) {
        corner[3 * k + axis] = coordinate(k, axis, lane);
        hn::Store(corner[3 * k + axis], d, triangles.corner[3 * k + axis] + lane);
      }
      hn::Store(least(corner[axis], corner[3 + axis], corner[6 + axis]), d, triangles.lo[axis] + lane);
      hn::Store(greatest(corner[axis], corner[3 + axis], corner[6 + axis]), d, triangles.hi[axis] + lane);
    }
    const auto edge = [&](int k, int axis) HWY_ATTR { return hn::Sub(corner[3 * k + axis], corner[axis]); };
    for (int axis = 0; axis < 3; ++axis) {
      const int i = (axis + 1) % 3, j = (axis + 2) % 3;
      n[axis] = hn::Sub(hn::Mul(edge(1, i), edge(2, j)), hn::Mul(edge(1, j), edge(2, i)));
    }
    const V scale = reciprocal_length(n);
    for (int axis = 0; axis < 3; ++axis) {
      n[axis] = hn::Mul(n[axis], scale);
      hn::Store(n[axis], d, triangles.normal[axis] + lane);
    }
    const V x = along(n, corner), y = along(n, corner + 3), z = along(n, corner + 6);
    hn::Store(least(x, y, z), d, triangles.lo_along + lane);
    hn::Store(greatest(x, y, z), d, triangles.hi_along + lane);
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

/// Triangle `i` of A and as many of B's as there are lanes; gaps between them are below 0 where there is none.
class TriangleAgainstLanes {
 public:
  HWY_INLINE TriangleAgainstLanes(const Triangles& a, std::uint32_t i, const Triangles& b, std::uint32_t lane)
      : a_(a), b_(b), i_(i), lane_(lane) {
    for (int k = 0; k < 9; ++k) of_a_[k] = hn::Set(d, a.corner[k][i]), of_b_[k] = hn::Load(d, b.corner[k] + lane);
  }

  /// Along the lines between the middles.
  HWY_INLINE V gap_of_middles() const {
    V n[3];
    for (int k = 0; k < 3; ++k)
      n[k] = hn::Sub(hn::Add(of_b_[k], hn::Add(of_b_[3 + k], of_b_[6 + k])),
                     hn::Add(of_a_[k], hn::Add(of_a_[3 + k], of_a_[6 + k])));
    const V gap = hn::Sub(least(along(n, of_b_), along(n, of_b_ + 3), along(n, of_b_ + 6)),
                          greatest(along(n, of_a_), along(n, of_a_ + 3), along(n, of_a_ + 6)));
    return hn::Mul(gap, reciprocal_length(n));
  }

  /// The greater of those along the two normals.
  HWY_INLINE V gap_of_planes() const {
    V n[3];
    for (int k = 0; k < 3; ++k) n[k] = hn::Set(d, a_.normal[k][i_]);
    const V gap = gap_along(n, of_b_, hn::Set(d, a_.lo_along[i_]), hn::Set(d, a_.hi_along[i_]));
    for (int k = 0; k < 3; ++k) n[k] = hn::Load(d, b_.normal[k] + lane_);
    return hn::Max(gap, gap_along(n, of_a_, hn::Load(d, b_.lo_along + lane_), hn::Load(d, b_.hi_along + lane_)));
  }

 private:
  static HWY_INLINE V gap_along(const V* n, const V* corners, V lo, V hi) {
    const V x = along(n, corners), y = along(n, corners + 3), z = along(n, corners + 6);
    return hn::Max(hn::Sub(least(x, y, z), hi), hn::Sub(lo, greatest(x, y, z)));
  }

  static constexpr TriangleLanes d{};
  const Triangles &a_, &b_;
  std::uint32_t i_, lane_;
  V of_a_[9], of_b_[9];
};

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

/// Which of A's triangles from `lane` on may be within the limit of B's box, by their boxes and planes. The box's faces
/// and its extent along a normal are rounded about as often as B's corners are: the slacks are taken twice.
HWY_INLINE unsigned near_box(const Triangles& a, std::size_t lane, const WideLeaf& b, const FrameRelation& f,
                             float scale, float slack, float slack_of_slab, float most) {
  const TriangleLanes d;
  V square = hn::Zero(d), center = hn::Zero(d), extent = hn::Set(d, 2 * slack_of_slab);
  for (int axis = 0; axis < 3; ++axis) {
    float half = 2 * slack;
    for (int k = 0; k < 3; ++k) half += std::abs(f.columns[k][axis]) * scale * b.half[k];
    const V x = gap(d,
                    hn::Max(hn::Sub(hn::Load(d, a.lo[axis] + lane), hn::Set(d, f.c[axis])),
                            hn::Sub(hn::Set(d, f.c[axis]), hn::Load(d, a.hi[axis] + lane))),
                    hn::Set(d, half));
    square = hn::MulAdd(x, x, square);
    const V n = hn::Load(d, a.normal[axis] + lane);
    center = hn::MulAdd(n, hn::Set(d, f.c[axis]), center);
  }
  for (int k = 0; k < 3; ++k) {
    V part = hn::Zero(d);
    for (int axis = 0; axis < 3; ++axis)
      part = hn::MulAdd(hn::Load(d, a.normal[axis] + lane), hn::Set(d, f.columns[k][axis]), part);
    extent = hn::MulAdd(hn::Abs(part), hn::Set(d, scale * b.half[k]), extent);
  }
  const V beyond =
      gap(d, hn::Max(hn::Sub(hn::Load(d, a.lo_along + lane), center), hn::Sub(center, hn::Load(d, a.hi_along + lane))),
          extent);
  return mask_bits(d, hn::Le(hn::Max(square, hn::Mul(beyond, beyond)), hn::Set(d, most)));
}

/// The least distance of A's triangles from one corner of B's, or more, but for the roundings of places that a slab's
/// slack covers: it is that of some points of the triangles, be they the nearest or not, whose two factors are from 0
/// to 1 whatever was rounded.
HWY_INLINE float distance_of_corner(const Triangles& a, std::uint32_t count, const Triangles& b) {
  const TriangleLanes d;
  const V one = hn::Set(d, 1.0f);
  V nearest = hn::Set(d, kFar);
  for (std::uint32_t lane = 0; lane < count; lane += static_cast<std::uint32_t>(hn::Lanes(d))) {
    V e[3], g[3], r[3];
    for (int k = 0; k < 3; ++k) {
      const V corner = hn::Load(d, a.corner[k] + lane);
      e[k] = hn::Sub(hn::Load(d, a.corner[3 + k] + lane), corner);
      g[k] = hn::Sub(hn::Load(d, a.corner[6 + k] + lane), corner);
      r[k] = hn::Sub(hn::Set(d, b.corner[k][0]), corner);
    }
    const V ee = along(e, e), eg = along(e, g), gg = along(g, g), re = along(r, e), rg = along(r, g);
    const auto part = [&](V x, V y) HWY_ATTR {
      const V square = hn::Max(hn::Sub(hn::Mul(ee, gg), hn::Mul(eg, eg)), hn::Set(d, 1e-30f));
      return hn::Min(hn::Max(hn::Div(hn::Sub(x, y), square), hn::Zero(d)), one);
    };
    V s = part(hn::Mul(re, gg), hn::Mul(rg, eg)), t = part(hn::Mul(rg, ee), hn::Mul(re, eg));
    const V over = hn::Max(hn::Add(s, t), one);
    s = hn::Div(s, over), t = hn::Div(t, over);
    for (int k = 0; k < 3; ++k) r[k] = hn::NegMulAdd(s, e[k], hn::NegMulAdd(t, g[k], r[k]));
    nearest = hn::Min(nearest, hn::IfThenElse(hn::FirstN(d, count - lane), hn::Sqrt(along(r, r)), nearest));
  }
  return hn::GetLane(hn::MinOfLanes(d, nearest));
}

HWY_ATTR void bound_triangles(const WideLeaf& a, const WideLeaf& b, const TreeRelation& trees, float limit,
                              Wanted wanted, std::vector<NearTriangles>& near) {
  const FrameRelation f = hierarchy::HWY_NAMESPACE::relate_frames(a.frame, b.frame, trees);
  const auto scale = static_cast<float>(trees.scale);
  Triangles of_a, of_b;
  lay_out_own(a, of_a);
  lay_out_mapped(b, f, scale, of_b);
  const TriangleLanes d;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  const float slack = slack_of(a, b, f, trees), shrink = shrink_of(trees);
  float most = square_of(limit, shrink);
  // Beyond this products would overflow; FarBounds are better there anyway.
  const float slack_of_slab = std::min(slab_slack(a, b, f, trees, slack), kFar);
  const bool use_slabs = slack_of_slab < 1e3f;
  // The nearest pair is not farther than any other: limits beyond the leaves are lowered to what one corner says.
  if (use_slabs && wanted == Wanted::nearest && most > f.c[0] * f.c[0] + f.c[1] * f.c[1] + f.c[2] * f.c[2])
    most = std::min(most, square_of((distance_of_corner(of_a, a.count, of_b) + 2 * slack_of_slab) / shrink, shrink));
  near.clear();
  alignas(64) float lower[16];
  unsigned some = ~0u;  // of A's triangles, a vector of them at a time
  for (std::uint32_t i = 0; i < a.count; ++i) {
    if (use_slabs && i % lanes == 0) some = near_box(of_a, i, b, f, scale, slack, slack_of_slab, most);
    if ((some >> (i % lanes) & 1) == 0) continue;
    for (std::uint32_t lane = 0; lane < b.count; lane += lanes) {
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
      V length = hn::Sqrt(square);
      if (use_slabs) {
        const TriangleAgainstLanes pairs(of_a, i, of_b, lane);
        const auto within = [&](V gap) HWY_ATTR {
          return mask_bits(d, hn::Le(hn::Mul(gap, hn::Max(gap, hn::Zero(d))), hn::Set(d, most)));
        };
        V slab = hn::Sub(pairs.gap_of_middles(), hn::Set(d, slack_of_slab));
        if ((bits &= within(slab)) == 0) continue;
        slab = hn::Max(slab, hn::Sub(pairs.gap_of_planes(), hn::Set(d, slack_of_slab)));
        if ((bits &= within(slab)) == 0) continue;
        length = hn::Max(slab, hn::IfThenElse(hn::Gt(length, hn::Zero(d)), length, slab));
      }
      hn::Store(hn::Mul(length, hn::Set(d, shrink)), d, lower);
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
                     const hierarchy::TreeRelation& relation, float limit, Wanted wanted,
                     std::vector<NearTriangles>& near) {
  HWY_DYNAMIC_DISPATCH(bound_triangles)(a, b, relation, limit, wanted, near);
}

}  // namespace impinge::measure
#endif
