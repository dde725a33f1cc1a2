// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/leaf_features.hpp"

#include <bit>

#include "impinge/impacts.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "motion/leaf_features.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/mask_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::motion::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A bit for each of the first `count` boxes that may come so near to box i of `one`: those with no axis along which
/// they are farther apart at the start and at the last time, in the same order. (The gap along an axis is a linear
/// function of time, above the reach throughout if it is so at both ends. A difference rounds to a float above the
/// reach only if it is.)
//
// Before the end the gap is g + t (h - g), of the gaps g and h at both ends. Coordinates are between -1 and 1 and, as
// floats, off by 2^-25: with u = 2^-24 gaps are off by u, and by 2 u more for their own rounding; their difference, the
// product and the sum take 4 u, 4 u and 2 u, the reach with that added 2 u more. That is less than 2^-19. Boxes of
// nothing are farther from all than any reach.
template <int kOne, int kCount>
HWY_INLINE std::uint32_t near(const PathBoxes<kOne>& one, int i, const PathBoxes<kCount>& boxes, int count,
                              Sought sought) {
  const hn::CappedTag<float, kCount % 16 == 0 ? 16 : kWidth> d;
  const float until = sought.until, most = until == 1 ? sought.reach : sought.reach + 0x1p-19f;
  std::uint32_t bits = 0;
  for (int lane = 0; lane < count; lane += static_cast<int>(hn::Lanes(d))) {
    const auto lanes = [&](int bound) HWY_ATTR { return hn::Load(d, boxes.bounds[bound] + lane); };
    const auto own = [&](int bound) HWY_ATTR { return hn::Set(d, one.bounds[bound][i]); };
    const auto least = [&](auto start, auto end) HWY_ATTR {
      return hn::Min(start, until == 1 ? end : hn::MulAdd(hn::Set(d, until), hn::Sub(end, start), start));
    };
    const auto gap = [&](int axis) HWY_ATTR {
      const int lo = axis, hi = 3 + axis, end = 6;
      const auto above = least(hn::Sub(lanes(lo), own(hi)), hn::Sub(lanes(end + lo), own(end + hi)));
      const auto below = least(hn::Sub(own(lo), lanes(hi)), hn::Sub(own(end + lo), lanes(end + hi)));
      return hn::Max(above, below);
    };
    const auto largest = hn::Max(hn::Max(gap(0), gap(1)), gap(2));
    bits |= impinge::HWY_NAMESPACE::mask_bits(d, hn::Le(largest, hn::Set(d, most))) << lane;
  }
  return bits & ((1u << count) - 1);
}

std::uint64_t may_meet(const PathTree::Node& a, const PathTree::Node& b, Sought sought) {
  std::uint64_t bits = 0;
  for (int i = 0; i < kWidth; ++i) bits |= std::uint64_t{near(a, i, b, kWidth, sought)} << (kWidth * i);
  return bits;
}

/// A bit for each of the group's features that has one of feature i's vertices.
template <class A, class B>
HWY_INLINE std::uint32_t sharing(const A& a, int i, const B& b) {
  const hn::CappedTag<std::uint32_t, (sizeof(b.index) / sizeof(b.index[0])) % 16 == 0 ? 16 : kWidth> d;
  std::uint32_t bits = 0;
  for (int lane = 0; lane < b.count; lane += static_cast<int>(hn::Lanes(d))) {
    auto any = hn::FirstN(d, 0);
    for (const auto& one : a.vertices)
      for (const auto& row : b.vertices) any = hn::Or(any, hn::Eq(hn::Set(d, one[i]), hn::Load(d, row + lane)));
    bits |= impinge::HWY_NAMESPACE::mask_bits(d, any) << lane;
  }
  return bits;
}

/// Those of both groups; of one group with itself each pair once.
template <class A, class B>
HWY_INLINE void pair_up(const A& a, std::uint32_t near_a, const B& b, std::uint32_t near_b, Leaves leaves, bool itself,
                        bool in_order, Sought sought, FeaturePairs::List& list) {
  for (; near_a != 0; near_a &= near_a - 1) {
    const int i = std::countr_zero(near_a);
    std::uint32_t bits = near(a.boxes, i, b.boxes, b.count, sought) & near_b;
    if (itself) bits &= ~((2u << i) - 1);
    if (bits != 0 && leaves != Leaves::of_two_meshes) bits &= ~sharing(a, i, b);
    for (; bits != 0; bits &= bits - 1) {
      const std::uint32_t one = a.index[i], two = b.index[std::countr_zero(bits)];
      const bool swap = in_order && one > two;
      list.pairs[list.count++] = {swap ? two : one, swap ? one : two};
    }
  }
}

void add_pairs(const LeafFeatures& a, const LeafFeatures& b, Leaves leaves, Sought sought, FeaturePairs& pairs) {
  const auto list = [&](Feature feature)
                        HWY_ATTR -> FeaturePairs::List& { return pairs.lists[static_cast<std::size_t>(feature)]; };
  const bool same = leaves == Leaves::the_same;
  std::uint32_t faces_a = (1u << a.faces.count) - 1, faces_b = (1u << b.faces.count) - 1;
  if (!same) {
    faces_b = near(a.box, 0, b.faces.boxes, b.faces.count, sought);
    std::uint32_t may_be = faces_b == 0 ? 0 : near(b.box, 0, a.faces.boxes, a.faces.count, sought);
    std::uint32_t met = 0;
    for (faces_a = 0; may_be != 0; may_be &= may_be - 1) {
      const int i = std::countr_zero(may_be);
      const std::uint32_t bits = near(a.faces.boxes, i, b.faces.boxes, b.faces.count, sought) & faces_b;
      met |= bits, faces_a |= std::uint32_t{bits != 0} << i;
    }
    if (faces_a == 0) return;
    faces_b = met;
  }
  // Of one leaf what is in the care of its faces that are left, and near the other.
  const auto left = [&](const auto& group, std::uint32_t faces, const std::uint32_t(&of)[kWidth],
                        const LeafFeatures& other) HWY_ATTR {
    std::uint32_t bits = 0;
    for (; faces != 0; faces &= faces - 1) bits |= of[std::countr_zero(faces)];
    return bits == 0 || same ? bits : bits & near(other.box, 0, group.boxes, group.count, sought);
  };
  pair_up(a.vertices, left(a.vertices, faces_a, a.vertices_of, b), b.faces, faces_b, leaves, false, false, sought,
          list(Feature::vertex_face));
  if (!same)
    pair_up(b.vertices, left(b.vertices, faces_b, b.vertices_of, a), a.faces, faces_a, leaves, false, false, sought,
            list(leaves == Leaves::of_two_meshes ? Feature::face_vertex : Feature::vertex_face));
  const std::uint32_t edges_a = left(a.edges, faces_a, a.edges_of, b);
  if (edges_a != 0)
    pair_up(a.edges, edges_a, b.edges, left(b.edges, faces_b, b.edges_of, a), leaves, same,
            leaves != Leaves::of_two_meshes, sought, list(Feature::edge_edge));
}

}  // namespace impinge::motion::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::motion {

HWY_EXPORT(may_meet);
HWY_EXPORT(add_pairs);

std::uint64_t may_meet(const PathTree::Node& a, const PathTree::Node& b, Sought sought) {
  return HWY_DYNAMIC_DISPATCH(may_meet)(a, b, sought);
}
void add_pairs(const LeafFeatures& a, const LeafFeatures& b, Leaves leaves, Sought sought, FeaturePairs& pairs) {
  HWY_DYNAMIC_DISPATCH(add_pairs)(a, b, leaves, sought, pairs);
}

void LeafFeatures::read(const PathTree& tree, const Features& features, std::size_t leaf) {
  faces.count = edges.count = vertices.count = 0;
  const auto add = [&](auto& group, std::uint32_t index, const auto& corners) {
    tree.bound(corners, group.boxes, group.count);
    for (std::size_t k = 0; k < group.kVertices; ++k) group.vertices[k][group.count] = corners[k];
    group.index[group.count++] = index;
  };
  // Triangles that are close in space may be anywhere in memory.
  for (const std::uint32_t i : tree.triangles_of(leaf))
    hwy::Prefetch(&features.corners[i]), hwy::Prefetch(&features.sides[i]), hwy::Prefetch(&features.care[i]);
  for (const std::uint32_t i : tree.triangles_of(leaf))
    for (const std::uint32_t corner : features.corners[i]) hwy::Prefetch(&tree.points[corner]);
  for (const std::uint32_t i : tree.triangles_of(leaf)) {
    const Corners& corners = features.corners[i];
    const int edges_before = edges.count, vertices_before = vertices.count, face = faces.count;
    add(faces, i, corners);
    for (int k = 0; k < 3; ++k) {
      if ((features.care[i] >> k & 1) != 0) add(vertices, corners[k], std::array{corners[k]});
      if ((features.care[i] >> (3 + k) & 1) != 0)
        add(edges, features.sides[i][k], std::array{corners[k], corners[(k + 1) % 3]});
    }
    edges_of[face] = (1u << edges.count) - (1u << edges_before);
    vertices_of[face] = (1u << vertices.count) - (1u << vertices_before);
  }
  box = tree.levels[0][leaf / kWidth].one(static_cast<int>(leaf % kWidth));
}

}  // namespace impinge::motion
#endif
