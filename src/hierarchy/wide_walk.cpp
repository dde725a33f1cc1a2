// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/wide_walk.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hierarchy/wide_walk.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/mask_bits-inl.hpp"
#include "hierarchy/leaf_against_box-inl.hpp"
#include "hierarchy/wide_boxes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

using impinge::HWY_NAMESPACE::mask_bits;

/// A bit for each box of `lanes` that may overlap box `i` of `one`: by the three axes of either frame.
HWY_INLINE unsigned overlapping(const BoxSide& one, int i, const BoxSide& lanes) {
  const hn::CappedTag<float, kWidth> d;
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kWidth; lane += hn::Lanes(d)) {
    const auto within = [&](int axis) HWY_ATTR {
      const auto own = hn::Abs(hn::Sub(hn::Load(d, lanes.mapped.center[axis] + lane), hn::Set(d, one.center[axis][i])));
      const auto own_reach = hn::Add(hn::Load(d, lanes.mapped.half[axis] + lane), hn::Set(d, one.half[axis][i]));
      const auto other =
          hn::Abs(hn::Sub(hn::LoadU(d, lanes.center[axis] + lane), hn::Set(d, one.mapped.center[axis][i])));
      const auto other_reach = hn::Add(hn::LoadU(d, lanes.half[axis] + lane), hn::Set(d, one.mapped.half[axis][i]));
      return hn::And(hn::Le(own, own_reach), hn::Le(other, other_reach));
    };
    const auto mask = hn::And(within(0), hn::And(within(1), within(2)));
    bits |= mask_bits(d, mask) << lane;
  }
  return bits;
}

/// The bit of the boxes whose centres are closest.
HWY_INLINE std::uint64_t nearest_of(std::uint64_t bits, const BoxSide& one, const BoxSide& lanes) {
  std::uint64_t nearest = 0;
  float least = 0;
  for (; bits != 0; bits &= bits - 1) {
    const int bit = std::countr_zero(bits), i = bit / kWidth, lane = bit % kWidth;
    float square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float difference = lanes.mapped.center[axis][lane] - one.center[axis][i];
      square += difference * difference;
    }
    if (square < least || nearest == 0) least = square, nearest = bits & -bits;
  }
  return nearest;
}

/// Which boxes of a pair may overlap: bit 8 i + j for box i of A and j of B, or i of B and j of A if B is not opened.
struct Overlaps {
  std::uint64_t bits;
  std::uint64_t nearest;  ///< the closest of them, if asked for
  Opening opening;
};

/// A leaf against the children of a node that is much the smaller, or a leaf of that size: which children's boxes some
/// triangle may touch, and of these, if asked for, the one whose centre is nearest to such a triangle's plane. By the
/// leaf's one box a large triangle would be held against every leaf below.
void meet_triangles(const TreeRefPair& pair, const FrameRelation& relation, const TreeRelation& trees,
                    bool with_nearest, Overlaps& result) {
  const auto scale = static_cast<float>(trees.scale);
  const bool both_leaves = pair.a.is_leaf() && pair.b.is_leaf();
  const bool leaf_is_a = both_leaves ? frame_of(pair.a).radius > scale * frame_of(pair.b).radius : pair.a.is_leaf();
  const WideLeaf& leaf = leaf_is_a ? pair.a.leaf() : pair.b.leaf();
  const TreeRef& other = leaf_is_a ? pair.b : pair.a;
  BoxSide boxes;
  Boxes own;
  const float scale_of_other = leaf_is_a ? scale : 1;
  both_leaves ? keep_whole(other, scale_of_other, own, boxes) : open(other.node(), scale_of_other, own, boxes);
  const float slack = slack_of(relation, trees, frame_of(pair.a).radius, frame_of(pair.b).radius);
  map_to_other(boxes, !leaf_is_a, relation, slack);
  const LeafAgainstNode lies(leaf, leaf_is_a ? 1 : scale, leaf_is_a, relation, boxes, slack);
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t lane = 0; lane < leaf.count; lane += hn::Lanes(TriangleLanes())) {
    const TrianglesAgainstBoxes triangles(lies, lane);
    for (int box = 0; box < boxes.size; ++box) {
      const auto meet = triangles.meet(box);
      if (hn::AllFalse(TriangleLanes(), meet)) continue;
      const std::uint64_t bit = std::uint64_t{1} << box;
      result.bits |= bit;
      if (!with_nearest) continue;
      if (const float height = triangles.height(box, meet); height < least) least = height, result.nearest = bit;
    }
  }
}

/// Of a node's children with each other: each with itself and with those that come after it.
constexpr std::uint64_t kOneOrder = [] {
  std::uint64_t bits = 0;
  for (int i = 0; i < kWidth; ++i)
    for (int j = i; j < kWidth; ++j) bits |= std::uint64_t{1} << (kWidth * i + j);
  return bits;
}();

Overlaps overlaps_of(const WideWalk& walk, const TreeRefPair& pair, const FrameRelation& relation, bool with_nearest,
                     WalkCounts& counts) {
  const TreeRelation& trees = walk.relation;
  Overlaps result{0, 0, opening_of(pair.a, pair.b, trees)};
  if (is_leaf_against_smaller(pair.a, pair.b, trees)) {
    counts.box_tests += result.opening.a ? pair.a.node().size : result.opening.b ? pair.b.node().size : 1;
    meet_triangles(pair, relation, trees, with_nearest, result);
    return result;
  }
  BoxSide a, b;
  Boxes own_a, own_b;
  open_both(pair.a, pair.b, result.opening, relation, trees, own_a, own_b, a, b);
  counts.box_tests += static_cast<std::uint64_t>(a.size) * static_cast<std::uint64_t>(b.size);

  const BoxSide &one = result.opening.b ? a : b, &lanes = result.opening.b ? b : a;
  const unsigned filled = (1u << lanes.size) - 1;
  for (int i = 0; i < one.size; ++i) result.bits |= std::uint64_t{overlapping(one, i, lanes) & filled} << (kWidth * i);
  if (walk.is_self && pair.a.bits() == pair.b.bits()) result.bits &= kOneOrder;
  if (with_nearest) result.nearest = nearest_of(result.bits, one, lanes);
  return result;
}

/// Where the next pairs go. There is room for all that a block may bring.
struct Ends {
  TreeRefPair* open;
  WideLeafPair* leaves;
};

/// Takes the pairs of children whose bits are set: leaves to the leaf pairs, the others to the stack. And so, but for
/// those that are `sure` to be worth it, a leaf with one of a sixteenth its size, to be held against its box first:
/// between leaves of less unequal sizes that costs more than it saves.
Ends descend(const WideWalk& walk, const TreeRefPair& pair, std::uint64_t bits, Opening opening, bool sure, Ends ends,
             WalkCounts& counts) {
  const auto child = [&](WideTree& tree, const TreeRef& parent, bool is_open, int lane) {
    return is_open ? tree.child(parent.node(), lane, counts.made, walk.for_each) : parent;
  };
  for (; bits != 0; bits &= bits - 1) {
    const int bit = std::countr_zero(bits), one = bit / kWidth, lane = bit % kWidth;
    const TreeRef a = child(walk.a, pair.a, opening.a, opening.b ? one : lane),
                  b = child(walk.b, pair.b, opening.b, opening.b ? lane : one);
    const bool both_leaves = a.is_leaf() && b.is_leaf() && (sure || !is_leaf_against_smaller(a, b, walk.relation, 16));
    // Written to both lists, and kept in one: a branch could not be predicted.
    *ends.open = {a, b};
    *ends.leaves = {&a.leaf(), &b.leaf()};
    ends.leaves += both_leaves, ends.open += !both_leaves;
  }
  return ends;
}

HWY_INLINE void prefetch(const TreeRefPair& pair) {
  for (const TreeRef ref : {pair.a, pair.b})
    for (std::size_t byte = 0; byte < 320; byte += 64) hwy::Prefetch(static_cast<const char*>(ref.address()) + byte);
}

void advance(const WideWalk& walk, std::vector<TreeRefPair>& stack, std::vector<WideLeafPair>& leaf_pairs,
             const WalkLimits& limits, WalkCounts& counts) {
  // A block of pairs is taken off the stack, and each step done for all of it: nodes are fetched ahead of their turn,
  // and no pair waits for its own numbers.
  constexpr std::size_t kAhead = 4;
  TreeRefPair block[WalkLimits::kMostAtOnce];
  FrameRelation relations[WalkLimits::kMostAtOnce];
  Overlaps overlaps[WalkLimits::kMostAtOnce];
  const std::size_t enough = leaf_pairs.size() + limits.leaf_pairs;
  const std::uint64_t last_test = counts.box_tests + limits.box_tests;
  while (!stack.empty() && leaf_pairs.size() < enough && counts.box_tests < last_test) {
    const std::size_t size = std::min(stack.size(), limits.at_once);
    std::copy_n(stack.end() - static_cast<std::ptrdiff_t>(size), size, block);
    stack.resize(stack.size() - size);
    for (std::size_t i = 0; i < size; ++i) {
      if (i + kAhead < size) prefetch(block[i + kAhead]);
      relations[i] = relate_frames(frame_of(block[i].a), frame_of(block[i].b), walk.relation);
    }
    std::size_t found = 0;
    for (std::size_t i = 0; i < size; ++i) {
      overlaps[i] = overlaps_of(walk, block[i], relations[i], limits.nearest_first, counts);
      found += static_cast<std::size_t>(std::popcount(overlaps[i].bits));
    }
    const std::size_t open = stack.size(), leaves = leaf_pairs.size();
    stack.resize(open + found), leaf_pairs.resize(leaves + found);
    Ends ends{stack.data() + open, leaf_pairs.data() + leaves};
    for (std::size_t i = 0; i < size; ++i) {
      const auto& [bits, nearest, opening] = overlaps[i];
      const bool was_leaf_pair = !opening.a && !opening.b;
      ends = descend(walk, block[i], bits & ~nearest, opening, was_leaf_pair, ends, counts);
      if (nearest != 0) ends = descend(walk, block[i], nearest, opening, true, ends, counts);
    }
    stack.resize(static_cast<std::size_t>(ends.open - stack.data()));
    leaf_pairs.resize(static_cast<std::size_t>(ends.leaves - leaf_pairs.data()));
  }
}

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::hierarchy {

HWY_EXPORT(advance);

void WideWalk::start(std::vector<TreeRefPair>& stack, WalkCounts& counts) const {
  const TreeRef root_a = a.root(counts.made, for_each), root_b = b.root(counts.made, for_each);
  stack.push_back({root_a, root_b});
}

void WideWalk::advance(std::vector<TreeRefPair>& stack, std::vector<WideLeafPair>& leaf_pairs, const WalkLimits& limits,
                       WalkCounts& counts) const {
  HWY_DYNAMIC_DISPATCH(advance)(*this, stack, leaf_pairs, limits, counts);
}

}  // namespace impinge::hierarchy
#endif
