// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Compiled once an instruction set: included after hwy/foreach_target.h, by that header's rules.
#if defined(IMPINGE_WIDE_BOXES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IMPINGE_WIDE_BOXES_INL
#undef IMPINGE_WIDE_BOXES_INL
#else
#define IMPINGE_WIDE_BOXES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "hierarchy/frame_relation-inl.hpp"
#include "hierarchy/wide_tree.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

/// Up to eight boxes, the x of all centres first, then their y, and so on.
struct alignas(64) Boxes {
  float center[3][kWidth];
  float half[3][kWidth];
};

/// Boxes about center - shift, turned by D, become boxes along the axes of the other frame that hold them, moved by
/// `move`; `slack` is added on all sides.
HWY_INLINE void map_boxes(const float center[3][kWidth], const float half[3][kWidth], const float D[3][3],
                          const float shift[3], const float move[3], float slack, Boxes& mapped) {
  const hn::CappedTag<float, kWidth> d;
  for (std::size_t lane = 0; lane < kWidth; lane += hn::Lanes(d)) {
    const auto shifted = [&](int i) HWY_ATTR { return hn::Sub(hn::LoadU(d, center[i] + lane), hn::Set(d, shift[i])); };
    const auto cx = shifted(0), cy = shifted(1), cz = shifted(2);
    const auto hx = hn::LoadU(d, half[0] + lane), hy = hn::LoadU(d, half[1] + lane), hz = hn::LoadU(d, half[2] + lane);
    for (int i = 0; i < 3; ++i) {
      const auto Dx = hn::Set(d, D[i][0]), Dy = hn::Set(d, D[i][1]), Dz = hn::Set(d, D[i][2]);
      hn::Store(hn::MulAdd(Dx, cx, hn::MulAdd(Dy, cy, hn::MulAdd(Dz, cz, hn::Set(d, move[i])))), d,
                mapped.center[i] + lane);
      hn::Store(
          hn::MulAdd(hn::Abs(Dx), hx, hn::MulAdd(hn::Abs(Dy), hy, hn::MulAdd(hn::Abs(Dz), hz, hn::Set(d, slack)))), d,
          mapped.half[i] + lane);
    }
  }
}

/// Boxes of one frame, also as mapped to another.
struct BoxSide {
  const float (*center)[kWidth];
  const float (*half)[kWidth];
  Boxes mapped;
  int size;
};

/// The boxes of a node's children; `own` keeps them where they are to be scaled.
HWY_INLINE void open(const WideNode& node, float scale, Boxes& own, BoxSide& side) {
  side.center = node.center, side.half = node.half, side.size = static_cast<int>(node.size);
  if (scale == 1) return;
  for (int i = 0; i < 3; ++i) {
    for (int lane = 0; lane < kWidth; ++lane) {
      own.center[i][lane] = scale * node.center[i][lane];
      own.half[i][lane] = lane < side.size ? scale * node.half[i][lane] : kNoBox;
    }
  }
  side.center = own.center, side.half = own.half;
}

/// A leaf's box, or one that holds all those of a node's children. The half extent comes from three roundings, each of
/// at most 2^-24 (|lo| + |hi|); 2^-21 as much is added.
HWY_INLINE void keep_whole(const TreeRef& ref, float scale, Boxes& own, BoxSide& side) {
  const hn::CappedTag<float, kWidth> d;
  for (int i = 0; i < 3; ++i) {
    float center = 0, half = 0;
    if (ref.is_leaf()) {
      half = ref.leaf().half[i];
    } else {
      const WideNode& node = ref.node();
      auto lo = hn::Set(d, -kNoBox), hi = hn::Set(d, kNoBox);  // which lanes without a child leave as they are
      for (std::size_t lane = 0; lane < kWidth; lane += hn::Lanes(d)) {
        const auto middle = hn::Load(d, node.center[i] + lane), reach = hn::Load(d, node.half[i] + lane);
        lo = hn::Min(lo, hn::Sub(middle, reach)), hi = hn::Max(hi, hn::Add(middle, reach));
      }
      const float least = hn::GetLane(hn::MinOfLanes(d, lo)), greatest = hn::GetLane(hn::MaxOfLanes(d, hi));
      center = 0.5f * (least + greatest);
      half = 0.5f * (greatest - least) + 0x1p-21f * (std::abs(least) + std::abs(greatest));
    }
    std::fill_n(own.center[i], kWidth, 0.0f);
    std::fill_n(own.half[i], kWidth, kNoBox);
    own.center[i][0] = scale * center, own.half[i][0] = scale * half;
  }
  side.center = own.center, side.half = own.half, side.size = 1;
}

/// Whose children are held against the other's box or boxes: those of both, or where one node is much the larger, its
/// own alone. (Twice as large is where that begins to gain; 1.5 times is no better.)
struct Opening {
  bool a, b;
};
HWY_INLINE Opening opening_of(const TreeRef& ref_a, const TreeRef& ref_b, const TreeRelation& trees) {
  if (ref_a.is_leaf() || ref_b.is_leaf()) return {!ref_a.is_leaf(), !ref_b.is_leaf()};
  const float a = frame_of(ref_a).radius, b = static_cast<float>(trees.scale) * frame_of(ref_b).radius;
  return {2 * a >= b, 2 * b >= a};
}

// Let x be a shared point in A's frame and y, in B's, the same as B has it; |x| <= r_a, |y| <= r_b (in A's unit) in
// every coordinate. With u = 2^-24, and frames orthonormal to within 2^-20:
//   x = C y + c + e, e from the double error of the relation, from F_B⁻¹ - F_Bᵀ (at most 5.2 * 2^-20 r_b), and from
//   rounding C (3 u r_b) and c (u |c|);
//   y = Cᵀ(x - c) + (I - CᵀC) y - Cᵀ e, and CᵀC differs from I by the defect of M and those of both frames: at most
//   sqrt 3 (3 defect + 6 * 2^-20 + 2^-21) r_b.
// The maps of centres and half extents add less than 13 u (r_a + r_b + |c|), the test itself less than 4 u as much
// where it is close. Underflow adds less than 2^-120.
HWY_INLINE float slack_of(const FrameRelation& relation, const TreeRelation& trees, float radius_a, float radius_b) {
  const float r_b = radius_b * static_cast<float>(trees.scale);
  const float far = std::abs(relation.c[0]) + std::abs(relation.c[1]) + std::abs(relation.c[2]);
  const float defect = static_cast<float>(trees.defect);
  return (0x1p-15f + 8 * defect) * r_b + 0x1p-19f * (radius_a + far) + 2 * static_cast<float>(trees.error) + 0x1p-100f;
}

/// A's boxes mapped to B's frame, or B's to A's.
HWY_INLINE void map_to_other(BoxSide& side, bool is_a, const FrameRelation& relation, float slack) {
  const auto& C = relation.columns;
  const float to_a[3][3] = {{C[0][0], C[1][0], C[2][0]}, {C[0][1], C[1][1], C[2][1]}, {C[0][2], C[1][2], C[2][2]}};
  const float to_b[3][3] = {{C[0][0], C[0][1], C[0][2]}, {C[1][0], C[1][1], C[1][2]}, {C[2][0], C[2][1], C[2][2]}};
  constexpr float kNone[3] = {0, 0, 0};
  if (is_a) {
    map_boxes(side.center, side.half, to_b, relation.c, kNone, slack, side.mapped);
  } else {
    map_boxes(side.center, side.half, to_a, kNone, relation.c, slack, side.mapped);
  }
}

/// The boxes of both, in A's unit, each mapped to the other's frame with the slack that this takes.
HWY_INLINE void open_both(const TreeRef& ref_a, const TreeRef& ref_b, Opening opening, const FrameRelation& relation,
                          const TreeRelation& trees, Boxes& own_a, Boxes& own_b, BoxSide& a, BoxSide& b) {
  const auto scale = static_cast<float>(trees.scale);
  opening.a ? open(ref_a.node(), 1, own_a, a) : keep_whole(ref_a, 1, own_a, a);
  opening.b ? open(ref_b.node(), scale, own_b, b) : keep_whole(ref_b, scale, own_b, b);
  const float slack = slack_of(relation, trees, frame_of(ref_a).radius, frame_of(ref_b).radius);
  map_to_other(a, true, relation, slack), map_to_other(b, false, relation, slack);
}

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // IMPINGE_WIDE_BOXES_INL
