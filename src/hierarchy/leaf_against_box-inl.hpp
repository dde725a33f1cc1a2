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

#include "hierarchy/wide_leaf.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The square of a lower bound of the distance between a leaf's triangles and a box in the leaf's frame, by the
/// triangles' boxes and by their planes; 0 if they may share a point. The box's numbers are in a unit in which the
/// leaf's are to be multiplied by `scale`. At most 1e36.
//
// Corners are off by e = scale * leaf.error each. With u = 2^-24, edges a and b from the first corner, A their largest
// coordinate, c from there to the box's centre, and E the largest coordinate of c with the box's largest half extent,
// det(a, b, x) is off for every x of the box, its six terms of a, b (each off by 2 e + u A) and x (off by e + u E), by
//   6 (2 (2 e + u A) A E + (e + u E) A A) from its inputs and 29 u A A E from its arithmetic.
// The same again covers what the computed normal's errors do to the box's extent along it and to its own length.
// Underflow adds less than 2^-110, for no coordinate is above a few times the trees' extents, which are about 1. The
// roundings of half + e and of the centre's difference from a corner are left to the slack in `half`, which is larger
// (hierarchy/wide_boxes-inl.hpp).
HWY_INLINE float square_gap(const WideLeaf& leaf, float scale, const float center[3], const float half[3]) {
  const hn::CappedTag<float, 16> d;
  using V = hn::Vec<decltype(d)>;
  const V factor = hn::Set(d, scale), error = hn::Set(d, scale * leaf.error), zero = hn::Zero(d);
  // Finite, so that no product is a NaN; and larger than any centre, which is at most 1e20 away.
  constexpr float kMostHalf = 1e25f;
  float reach_of_box[3];
  for (int i = 0; i < 3; ++i) reach_of_box[i] = half[i] < kMostHalf ? half[i] : kMostHalf;
  const V most_half = hn::Set(d, std::max(reach_of_box[0], std::max(reach_of_box[1], reach_of_box[2])));
  const V far = hn::Set(d, 1e18f);
  V least = hn::Set(d, 1e36f);
  for (std::size_t lane = 0; lane < leaf.count; lane += hn::Lanes(d)) {
    V a[3], b[3], c[3];
    V A = zero, E = zero, square = zero;
    for (int i = 0; i < 3; ++i) {
      const auto corner = [&](int k) HWY_ATTR { return hn::Mul(factor, hn::Load(d, leaf.row(3 * k + i) + lane)); };
      const V p = corner(0), q = corner(1), r = corner(2);
      const V middle = hn::Set(d, center[i]), reach = hn::Add(hn::Set(d, reach_of_box[i]), error);
      const V apart = hn::Max(hn::Sub(hn::Min(p, hn::Min(q, r)), middle), hn::Sub(middle, hn::Max(p, hn::Max(q, r))));
      const V gap = hn::Min(hn::Max(hn::Sub(apart, reach), zero), far);
      square = hn::MulAdd(gap, gap, square);
      a[i] = hn::Sub(q, p), b[i] = hn::Sub(r, p), c[i] = hn::Sub(middle, p);
      A = hn::Max(A, hn::Max(hn::Abs(a[i]), hn::Abs(b[i]))), E = hn::Max(E, hn::Abs(c[i]));
    }
    E = hn::Add(E, most_half);
    V along = zero, extent = zero, length = hn::Set(d, 0x1p-100f);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const V normal = hn::Sub(hn::Mul(a[j], b[k]), hn::Mul(a[k], b[j]));
      along = hn::MulAdd(normal, c[i], along);
      extent = hn::MulAdd(hn::Abs(normal), hn::Set(d, reach_of_box[i]), extent);
      length = hn::MulAdd(normal, normal, length);
    }
    // A (25 e E + 6.1 e A + 50 u A E), twice
    const V off = hn::Mul(hn::Mul(hn::Set(d, 2.0f), A),
                          hn::MulAdd(error, hn::MulAdd(hn::Set(d, 25.0f), E, hn::Mul(hn::Set(d, 6.1f), A)),
                                     hn::Mul(hn::Set(d, 0x1.9p-19f), hn::Mul(A, E))));
    const V beyond = hn::Sub(hn::Abs(along), hn::Add(hn::Add(extent, off), hn::Set(d, 0x1p-100f)));
    const V gap = hn::Min(hn::Max(hn::Div(beyond, hn::Sqrt(length)), zero), far);
    square = hn::Max(square, hn::Mul(gap, gap));
    least = hn::Min(least, hn::IfThenElse(hn::FirstN(d, leaf.count - lane), square, least));
  }
  return (1 - 0x1p-18f) * hn::GetLane(hn::MinOfLanes(d, least));
}

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // IMPINGE_LEAF_AGAINST_BOX_INL
