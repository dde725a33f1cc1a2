// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Compiled once an instruction set: included after hwy/foreach_target.h, by that header's rules.
#if defined(IMPINGE_LEAF_AGAINST_BOX_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IMPINGE_LEAF_AGAINST_BOX_INL
#undef IMPINGE_LEAF_AGAINST_BOX_INL
#else
#define IMPINGE_LEAF_AGAINST_BOX_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "hierarchy/wide_boxes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using TriangleLanes = hn::CappedTag<float, 16>;

/// A leaf, and boxes of a node of the other tree.
struct LeafAgainstNode {
  /// `relation` is that of the two, in which the leaf is A's or B's. The mapped boxes are in its frame, in a unit in
  /// which its numbers are to be multiplied by `scale`; mapping added `slack`.
  HWY_INLINE LeafAgainstNode(const WideLeaf& of_leaf, float leaf_scale, bool leaf_is_a, const FrameRelation& relation,
                             const BoxSide& of_node, float mapping_slack)
      : leaf(of_leaf), scale(leaf_scale), boxes(of_node), slack(std::min(mapping_slack, kMost)) {
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) turn[k][i] = leaf_is_a ? relation.columns[k][i] : relation.columns[i][k];
    const hn::CappedTag<float, kWidth> d;
    for (std::size_t lane = 0; lane < kWidth; lane += hn::Lanes(d)) {
      auto largest = hn::Zero(d);
      for (int i = 0; i < 3; ++i) {
        const auto center = hn::Load(d, boxes.mapped.center[i] + lane);
        const auto half = hn::Min(hn::Load(d, boxes.mapped.half[i] + lane), hn::Set(d, kMost));
        hn::Store(hn::Sub(center, half), d, lo[i] + lane);
        hn::Store(hn::Add(center, half), d, hi[i] + lane);
        largest = hn::Max(largest, hn::Add(hn::Abs(center), half));
      }
      hn::Store(hn::Add(largest, hn::Set(d, 1.001f * scale * leaf.frame.radius)), d, extent + lane);
    }
  }

  // Finite, so that no product is a NaN; and larger than any centre, which is at most 1e20 away.
  static constexpr float kMost = 1e25f;

  const WideLeaf& leaf;
  float scale;
  const BoxSide& boxes;
  float slack;
  float turn[3][3];                  ///< [k][i]: along axis i of the leaf's frame, of axis k of the boxes' own
  alignas(64) float lo[3][kWidth];   ///< of the mapped boxes
  alignas(64) float hi[3][kWidth];   ///< of the mapped boxes
  alignas(64) float extent[kWidth];  ///< at least the largest coordinates of the box and of the leaf, together
};

/// As many of a leaf's triangles as there are lanes, and the distance of boxes from them: by the triangles' boxes and
/// by their planes, on which a box's extent is that along its own axes.
//
// Corners are off by e = scale * leaf.error each. With u = 2^-24, edges a and b from the first corner p, A their
// largest coordinate and 2 e, so at least that of the exact ones, and E at least the largest coordinate of a corner and
// that of the box's centre and half extent, together, so that A <= 2 E: the computed normal n is at most 2 A A and off
// by at most 8 A (e + u A) a coordinate, and n x - n p, for the box's centre x, by 36 u A A E from six roundings of at
// most 6 A A E. The box's extent along n is off by 42 u A A E: 4 u of each of three products of n's in the box's frame,
// whose half extents are up to E, and three sums. A triangle's own extent along n is at most 24 A A (e + u A), and p is
// off by 6 e A A along it. In all less than 30 e A A + 126 u A A E.
// Underflow adds less than 2^-110, for no coordinate is above a few times the trees' extents, which are about 1. The
// roundings of a box's faces and of lo - e and hi + e are left to the slack, which is larger
// (hierarchy/wide_boxes-inl.hpp).
class TrianglesAgainstBoxes {
 public:
  using V = hn::Vec<TriangleLanes>;

  /// Those from number `lane` on.
  HWY_INLINE TrianglesAgainstBoxes(const LeafAgainstNode& pair, std::size_t lane) : pair_(pair) {
    const TriangleLanes d;
    const WideLeaf& leaf = pair.leaf;
    const V factor = hn::Set(d, pair.scale), error = hn::Set(d, pair.scale * leaf.error);
    V a[3], b[3], p[3], A = hn::Zero(d), flat = hn::Zero(d), length = hn::Set(d, 0x1p-100f);
    for (int i = 0; i < 3; ++i) {
      const auto corner = [&](int k) HWY_ATTR { return hn::Mul(factor, hn::Load(d, leaf.row(3 * k + i) + lane)); };
      p[i] = corner(0);
      const V q = corner(1), r = corner(2);
      lo_[i] = hn::Sub(hn::Min(p[i], hn::Min(q, r)), error), hi_[i] = hn::Add(hn::Max(p[i], hn::Max(q, r)), error);
      a[i] = hn::Sub(q, p[i]), b[i] = hn::Sub(r, p[i]);
      A = hn::Max(A, hn::Max(hn::Abs(a[i]), hn::Abs(b[i])));
    }
    level_ = hn::Zero(d);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      normal_[i] = hn::Sub(hn::Mul(a[j], b[k]), hn::Mul(a[k], b[j]));
      level_ = hn::MulAdd(normal_[i], p[i], level_);
      flat = hn::Add(flat, hn::Abs(normal_[i]));
      length = hn::MulAdd(normal_[i], normal_[i], length);
    }
    for (int k = 0; k < 3; ++k) {
      const auto part = [&](int i) HWY_ATTR { return hn::Set(d, pair.turn[k][i]); };
      turned_[k] =
          hn::Abs(hn::MulAdd(part(0), normal_[0], hn::MulAdd(part(1), normal_[1], hn::Mul(part(2), normal_[2]))));
    }
    length_ = hn::Sqrt(length);
    A = hn::MulAdd(hn::Set(d, 2.0f), error, A);
    const V square = hn::Mul(A, A);
    off_ = hn::MulAdd(hn::Set(d, pair.slack), flat,
                      hn::MulAdd(hn::Mul(square, error), hn::Set(d, 37.0f), hn::Set(d, 0x1p-100f)));
    off_by_E_ = hn::Mul(square, hn::Set(d, 0x1.4p-17f));  // 160 u
    size_ = leaf.count - lane;
  }

  /// The square of a lower bound of the distance between any of the triangles and a box; 0 if they may share a point.
  /// At most 3e36: each axis counts for 1e36 at most.
  HWY_INLINE float square_gap(int box) const {
    const TriangleLanes d;
    const V zero = hn::Zero(d), far = hn::Set(d, 1e18f);
    V square = zero;
    for (int i = 0; i < 3; ++i) {
      const V apart =
          hn::Max(hn::Sub(lo_[i], hn::Set(d, pair_.hi[i][box])), hn::Sub(hn::Set(d, pair_.lo[i][box]), hi_[i]));
      const V gap = hn::Min(hn::Max(apart, zero), far);
      square = hn::MulAdd(gap, gap, square);
    }
    const V gap = hn::Min(hn::Max(hn::Div(beyond(box), length_), zero), far);
    square = hn::IfThenElse(hn::FirstN(d, size_), hn::Max(square, hn::Mul(gap, gap)), hn::Set(d, 1e36f));
    return (1 - 0x1p-18f) * hn::GetLane(hn::MinOfLanes(d, square));
  }

 private:
  /// How far a box's centre is before the planes, times the length of the normal.
  HWY_INLINE V along(int box) const {
    V sum = level_;
    for (int i = 0; i < 3; ++i)
      sum = hn::NegMulAdd(normal_[i], hn::Set(TriangleLanes(), pair_.boxes.mapped.center[i][box]), sum);
    return sum;
  }

  /// The distance of a box from the planes, times the length of the normal; not above 0 if they may share a point.
  HWY_INLINE V beyond(int box) const {
    const TriangleLanes d;
    V extent = off_;
    for (int i = 0; i < 3; ++i) extent = hn::MulAdd(turned_[i], hn::Set(d, pair_.boxes.half[i][box]), extent);
    return hn::Sub(hn::Abs(along(box)), hn::MulAdd(off_by_E_, hn::Set(d, pair_.extent[box]), extent));
  }

  const LeafAgainstNode& pair_;
  V lo_[3], hi_[3], normal_[3], turned_[3];
  V level_, length_, off_, off_by_E_;
  std::size_t size_;
};

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // IMPINGE_LEAF_AGAINST_BOX_INL
