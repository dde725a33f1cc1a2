// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/refit_node.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hierarchy/carried_axes.hpp"
#include "hierarchy/round_up.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hierarchy/refit_node.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hierarchy/float4-inl.hpp"

// No fused operations here: the tree is the same on every instruction set.
HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

/// How a leaf's frame lies in a node's: x = C y + c.
struct LeafRelation {
  Float4 columns[3], c;
};
HWY_INLINE LeafRelation relate(const Frame& node, const Frame& leaf) {
  const auto turned = [&](float x, float y, float z) HWY_ATTR {
    return Float4::load(node.axes[0]) * Float4::all(x) + Float4::load(node.axes[1]) * Float4::all(y) +
           Float4::load(node.axes[2]) * Float4::all(z);
  };
  LeafRelation relation;
  for (int k = 0; k < 3; ++k) relation.columns[k] = turned(leaf.axes[0][k], leaf.axes[1][k], leaf.axes[2][k]);
  relation.c =
      turned(static_cast<float>(leaf.origin[0] - node.origin[0]), static_cast<float>(leaf.origin[1] - node.origin[1]),
             static_cast<float>(leaf.origin[2] - node.origin[2]));
  return relation;
}

/// The box of a leaf's stored corners.
void bound_corners(const WideLeaf& leaf, const Frame& node, ChildBox& box) {
  const LeafRelation relation = relate(node, leaf.frame);
  float columns[3][4], c[4];
  for (int k = 0; k < 3; ++k) relation.columns[k].store(columns[k]);
  relation.c.store(c);
  const std::size_t last = leaf.count < 8 ? 0 : leaf.count - 8;  // where the last eight begin
  alignas(64) float few[9][8];
  if (leaf.count < 8) {
    for (int row = 0; row < 9; ++row)
      for (std::uint32_t j = 0; j < 8; ++j) few[row][j] = leaf.row(row)[std::min(j, leaf.count - 1)];
  }
  for (int i = 0; i < 3; ++i) {
    const Float8 x = Float8::all(columns[0][i]), y = Float8::all(columns[1][i]), z = Float8::all(columns[2][i]);
    Float8 lo = Float8::all(3e38f), hi = Float8::all(-3e38f);
    for (int corner = 0; corner < 3; ++corner) {
      for (std::size_t j = 0; j <= last; j = j < last ? std::min(j + 8, last) : last + 1) {
        const auto eight = [&](int coordinate) HWY_ATTR {
          const int row = 3 * corner + coordinate;
          const float* const from = leaf.count < 8 ? few[row] : leaf.row(row) + j;
          return Float8::of(Float4::load(from), Float4::load(from + 4));
        };
        const Float8 along = x * eight(0) + y * eight(1) + z * eight(2);
        lo = min(lo, along), hi = max(hi, along);
      }
    }
    float low[4], high[4];
    min(lo.front(), lo.back()).store(low), max(hi.front(), hi.back()).store(high);
    box.lo[i] = std::min({low[0], low[1], low[2], low[3]}) + c[i];
    box.hi[i] = std::max({high[0], high[1], high[2], high[3]}) + c[i];
  }
  box.radius = leaf.frame.radius;
}

/// The box of the leaves' boxes.
void bound_boxes(std::span<const WideLeaf* const> leaves, const Frame& node, ChildBox& box) {
  const auto abs = [](const Float4& v) HWY_ATTR { return max(v, Float4::all(0) - v); };
  Float4 lo = Float4::all(3e38f), hi = Float4::all(-3e38f);
  float radius = 0;
  for (const WideLeaf* const leaf : leaves) {
    const LeafRelation relation = relate(node, leaf->frame);
    const Float4 reach = abs(relation.columns[0]) * Float4::all(leaf->half[0]) +
                         abs(relation.columns[1]) * Float4::all(leaf->half[1]) +
                         abs(relation.columns[2]) * Float4::all(leaf->half[2]);
    lo = min(lo, relation.c - reach), hi = max(hi, relation.c + reach);
    radius = std::max(radius, leaf->frame.radius);
  }
  float low[4], high[4];
  lo.store(low), hi.store(high);
  std::copy(low, low + 3, box.lo), std::copy(high, high + 3, box.hi);
  box.radius = radius;
}

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::hierarchy {
HWY_EXPORT(bound_corners);
HWY_EXPORT(bound_boxes);
namespace {

Vec3 origin_of(const Frame& frame) { return {frame.origin[0], frame.origin[1], frame.origin[2]}; }

/// Amid the children, with axes that have turned as the children's have, in the mean over the triangles.
void carry_frame(const WideNode& old, const RefittedChild (&children)[kWidth], WideNode& node) {
  double triangles = 0;
  Vec3 sum{};
  Mat3 turn{};
  for (std::uint32_t lane = 0; lane < node.size; ++lane) {
    const Frame& is = frame_of(children[lane].ref);
    const Frame& was = frame_of(TreeRef(old.child[lane].load(std::memory_order_acquire)));
    const double weight = node.count[lane];
    triangles += weight, sum = sum + weight * origin_of(is);
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis = weight * axis_of(is, i);
      turn[0] = turn[0] + double{was.axes[0][i]} * axis, turn[1] = turn[1] + double{was.axes[1][i]} * axis;
      turn[2] = turn[2] + double{was.axes[2][i]} * axis;
    }
  }
  Mat3 carried;
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = axis_of(old.frame, i);
    carried[static_cast<std::size_t>(i)] = axis.x * turn[0] + axis.y * turn[1] + axis.z * turn[2];
  }
  carry_axes(carried, old.frame, node.frame);
  const Vec3 origin = (1 / triangles) * sum;
  node.frame.origin[0] = origin.x, node.frame.origin[1] = origin.y, node.frame.origin[2] = origin.z;
  node.frame.origin[3] = 0;
  node.base = origin;
}

// Let v be a vertex, x its exact coordinates in a leaf's frame, each at most r, and y those in the node's, so that
// y = F_n F_l⁻¹ x + F_n (o_l - o_n). With u = 2^-24, frames orthonormal to within 2^-20, and R the largest coordinate
// in the child's box, y differs from what is computed as C x + c by at most
//   84 u r        for F_lᵀ instead of F_l⁻¹ (5.2 * 2^-20 r, as in wide_boxes-inl.hpp),
//   9 u r, 7 u R  for the three products and two sums in each entry of C and of c, and the rounding of o_l - o_n,
//   7 u r, 5 u R  for those of C x, or of |C| and a box's half extents, and for adding c.
// Stored corners are within `error` of the exact ones, which C takes to at most sqrt 3 as much; a leaf's box allows for
// that.
double slack(double radius, double reach, double error) {
  return 0x1p-17 * radius + 0x1p-20 * reach + 2 * error + kNothing;
}

}  // namespace

void refit_node(const WideNode& old, const RefittedChild (&children)[kWidth], WideNode& node) {
  node.size = old.size, node.depth = old.depth;
  std::copy(old.first, old.first + kWidth, node.first), std::copy(old.count, old.count + kWidth, node.count);
  carry_frame(old, children, node);
  double radius = 0;
  for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
    const bool is_used = lane < node.size;
    node.child[lane].store(is_used ? children[lane].ref.bits() : 0, std::memory_order_relaxed);
    ChildBox box{};
    double margin = 0;
    if (is_used) {
      const bool is_leaf = children[lane].ref.is_leaf();
      is_leaf ? HWY_DYNAMIC_DISPATCH(bound_corners)(children[lane].ref.leaf(), node.frame, box)
              : HWY_DYNAMIC_DISPATCH(bound_boxes)(children[lane].leaves, node.frame, box);
      float reach = 0;
      for (int i = 0; i < 3; ++i) reach = std::max({reach, -box.lo[i], box.hi[i]});
      margin = slack(box.radius, reach, is_leaf ? children[lane].ref.leaf().error : 0);
      radius = std::max(radius, reach + margin);
    }
    for (int i = 0; i < 3; ++i) {
      const double lo = box.lo[i], hi = box.hi[i];
      const float middle = static_cast<float>(0.5 * (lo + hi));
      node.center[i][lane] = middle;
      node.half[i][lane] = is_used ? round_up(std::max(hi - middle, middle - lo) + margin) : kNoBox;
    }
  }
  node.frame.radius = round_up(radius);
}

}  // namespace impinge::hierarchy
#endif  // HWY_ONCE
