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

/// A bit for each of `kLanes` boxes that may come so near to box i of `one`: those with no axis along which they are
/// farther apart at the start and at the last time, in the same order. (The gap along an axis is a linear function of
/// time, above the reach throughout if it is so at both ends. A difference rounds to a float above the reach only if it
/// is.)
//
// Before the end the gap is g + t (h - g), of the gaps g and h at both ends. Coordinates are between -1 and 1 and, as
// floats, off by 2^-25: with u = 2^-24 gaps are off by u, and by 2 u more for their own rounding; their difference, the
// product and the sum take 4 u, 4 u and 2 u, the reach with that added 2 u more. That is less than 2^-19. Boxes of
// nothing are farther from all than any reach.
template <int kLanes, int kOne, int kCount>
HWY_INLINE std::uint32_t near(const PathBoxes<kOne>& one, int i, const PathBoxes<kCount>& boxes, Sought sought) {
  const hn::CappedTag<float, kLanes> d;
  const float until = sought.until, most = until == 1 ? sought.reach : sought.reach + 0x1p-19f;
  std::uint32_t bits = 0;
  for (int lane = 0; lane < kLanes; lane += static_cast<int>(hn::Lanes(d))) {
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
  return bits;
}

std::uint64_t may_meet(const PathTree::Node& a, const PathTree::Node& b, Sought sought) {
  std::uint64_t bits = 0;
  for (int i = 0; i < kWidth; ++i) bits |= std::uint64_t{near<kWidth>(a, i, b, sought)} << (kWidth * i);
  return bits;
}

using Block = LeafFeatures::Block;
constexpr int kBlock = LeafFeatures::kBlock;

/// A bit for each of the first `kLanes` features of a block that has one of feature i's vertices, which are `kOne` and
/// `kOther` at most.
template <int kLanes, int kOne, int kOther>
HWY_INLINE std::uint32_t sharing(const Block& a, int i, const Block& b) {
  const hn::CappedTag<std::uint32_t, kLanes> d;
  std::uint32_t bits = 0;
  for (int lane = 0; lane < kLanes; lane += static_cast<int>(hn::Lanes(d))) {
    auto any = hn::FirstN(d, 0);
    for (int one = 0; one < kOne; ++one)
      for (int other = 0; other < kOther; ++other)
        any = hn::Or(any, hn::Eq(hn::Set(d, a.vertices[one][i]), hn::Load(d, b.vertices[other] + lane)));
    bits |= impinge::HWY_NAMESPACE::mask_bits(d, any) << lane;
  }
  return bits;
}

/// Those of a leaf that are near the other leaf's box; nothing if no face is.
HWY_INLINE std::uint64_t near_leaf(const PathBoxes<1>& box, const LeafFeatures& leaf, Sought sought) {
  std::uint64_t bits = near<kBlock>(box, 0, leaf.blocks[0].boxes, sought) & leaf.all;
  if ((bits & LeafFeatures::kFaceBits) == 0) return 0;
  for (int block = 1; block < LeafFeatures::kBlocks; ++block)
    if (const std::uint64_t of_block = leaf.all & std::uint64_t{0xFFFF} << (kBlock * block); of_block != 0)
      bits |= std::uint64_t{near<kBlock>(box, 0, leaf.blocks[block].boxes, sought)} << (kBlock * block) & of_block;
  return bits;
}

/// Some vertices of a leaf with the faces of another one.
HWY_INLINE void pair_faces(const LeafFeatures& a, std::uint64_t vertices, const LeafFeatures& b, Leaves leaves,
                           Sought sought, FeaturePairs::List& list) {
  const Block& faces = b.blocks[0];
  for (; vertices != 0; vertices &= vertices - 1) {
    const int at = std::countr_zero(vertices), i = at % kBlock;
    const Block& own = a.blocks[at / kBlock];
    std::uint32_t bits = near<kWidth>(own.boxes, i, faces.boxes, sought) & static_cast<std::uint32_t>(b.all);
    if (bits != 0 && leaves != Leaves::of_two_meshes) bits &= ~sharing<kWidth, 1, 3>(own, i, faces);
    for (; bits != 0; bits &= bits - 1) list.pairs[list.count++] = {own.index[i], faces.index[std::countr_zero(bits)]};
  }
}

/// Some edges of a leaf with some of another one, or of it; of one leaf each pair once. `swapped`: leaf `b` stands
/// first in pairs of two meshes.
HWY_INLINE void pair_edges(const LeafFeatures& a, std::uint64_t edges, const LeafFeatures& b, std::uint64_t others,
                           Leaves leaves, bool swapped, Sought sought, FeaturePairs::List& list) {
  for (; edges != 0; edges &= edges - 1) {
    const int at = std::countr_zero(edges), i = at % kBlock;
    const Block& own = a.blocks[at / kBlock];
    if (leaves == Leaves::the_same) others = edges & (edges - 1);
    for (int block = LeafFeatures::kEdges / kBlock; others >> (kBlock * block) != 0; ++block) {
      const Block& other = b.blocks[block];
      std::uint32_t bits = static_cast<std::uint32_t>(others >> (kBlock * block)) & 0xFFFF;
      bits &= near<kBlock>(own.boxes, i, other.boxes, sought);
      if (bits != 0 && leaves != Leaves::of_two_meshes) bits &= ~sharing<kBlock, 2, 2>(own, i, other);
      for (; bits != 0; bits &= bits - 1) {
        const std::uint32_t one = own.index[i], two = other.index[std::countr_zero(bits)];
        const bool swap = leaves == Leaves::of_two_meshes ? swapped : one > two;
        list.pairs[list.count++] = {swap ? two : one, swap ? one : two};
      }
    }
  }
}

void add_pairs(const LeafFeatures& a, const LeafFeatures& b, Leaves leaves, Sought sought, FeaturePairs& pairs) {
  const auto list = [&](Feature feature)
                        HWY_ATTR -> FeaturePairs::List& { return pairs.lists[static_cast<std::size_t>(feature)]; };
  std::uint64_t in_a = a.all, in_b = b.all;
  if (leaves != Leaves::the_same) {
    in_a = near_leaf(b.box, a, sought);
    if (in_a == 0) return;
    in_b = near_leaf(a.box, b, sought);
    if (in_b == 0) return;
    pair_faces(b, in_b & LeafFeatures::kVertexBits, a, leaves, sought,
               list(leaves == Leaves::of_two_meshes ? Feature::face_vertex : Feature::vertex_face));
  }
  pair_faces(a, in_a & LeafFeatures::kVertexBits, b, leaves, sought, list(Feature::vertex_face));
  const std::uint64_t edges_a = in_a & LeafFeatures::kEdgeBits, edges_b = in_b & LeafFeatures::kEdgeBits;
  const bool swapped = std::popcount(edges_b) < std::popcount(edges_a);  // one after the other, the fewer ones
  if (swapped)
    pair_edges(b, edges_b, a, edges_a, leaves, true, sought, list(Feature::edge_edge));
  else
    pair_edges(a, edges_a, b, edges_b, leaves, false, sought, list(Feature::edge_edge));
}

/// Writes the boxes of all features, by their vertices.
void bound(const PathTree& tree, LeafFeatures& leaf) {
  const hn::CappedTag<float, PathTree::Point::kSize> d;
  for (std::uint64_t bits = leaf.all; bits != 0; bits &= bits - 1) {
    const int at = std::countr_zero(bits), i = at % kBlock;
    Block& block = leaf.blocks[at / kBlock];
    const auto point = [&](int k) HWY_ATTR { return tree.points[block.vertices[k][i]].at; };
    const float *a = point(0), *b = point(1), *c = point(2);
    PathTree::Around around;
    for (int k = 0; k < PathTree::Point::kSize; k += static_cast<int>(hn::Lanes(d))) {
      const auto x = hn::Load(d, a + k), y = hn::Load(d, b + k), z = hn::Load(d, c + k);
      hn::Store(hn::Min(hn::Min(x, y), z), d, around.lo.at + k);
      hn::Store(hn::Max(hn::Max(x, y), z), d, around.hi.at + k);
    }
    around.write(tree.margin, block.boxes, i);
  }
}

}  // namespace impinge::motion::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::motion {

HWY_EXPORT(may_meet);
HWY_EXPORT(add_pairs);
HWY_EXPORT(bound);

std::uint64_t may_meet(const PathTree::Node& a, const PathTree::Node& b, Sought sought) {
  return HWY_DYNAMIC_DISPATCH(may_meet)(a, b, sought);
}
void add_pairs(const LeafFeatures& a, const LeafFeatures& b, Leaves leaves, Sought sought, FeaturePairs& pairs) {
  HWY_DYNAMIC_DISPATCH(add_pairs)(a, b, leaves, sought, pairs);
}

void LeafFeatures::read(const PathTree& tree, const Features& features, std::size_t leaf) {
  const auto triangles = tree.triangles_of(leaf);
  // Triangles that are close in space may be anywhere in memory.
  for (const std::uint32_t i : triangles)
    hwy::Prefetch(&features.corners[i]), hwy::Prefetch(&features.sides[i]), hwy::Prefetch(&features.care[i]);
  for (const std::uint32_t i : triangles)
    for (const std::uint32_t corner : features.corners[i]) hwy::Prefetch(&tree.points[corner]);
  int faces = 0, vertices = 0, edges = 0;
  all = 0;
  const auto add = [&](int at, std::uint32_t index, const Corners& of) {
    Block& block = blocks[at / kBlock];
    const int i = at % kBlock;
    block.index[i] = index;
    for (int k = 0; k < 3; ++k) block.vertices[k][i] = of[k];
    all |= std::uint64_t{1} << at;
  };
  for (const std::uint32_t i : triangles) {
    const Corners& corners = features.corners[i];
    const unsigned care = features.care[i];
    add(faces++, i, corners);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t one = corners[k], two = corners[(k + 1) % 3];
      if ((care >> k & 1) != 0) {
        add(vertices < kWidth ? kVertices + vertices : kOtherVertices + vertices - kWidth, one, {one, one, one});
        ++vertices;
      }
      if ((care >> (3 + k) & 1) != 0) add(kEdges + edges++, features.sides[i][k], {one, two, two});
    }
  }
  HWY_DYNAMIC_DISPATCH(bound)(tree, *this);
  box = tree.levels[0][leaf / kWidth].one(static_cast<int>(leaf % kWidth));
}

}  // namespace impinge::motion
#endif
