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
#include "hierarchy/large_leaf-inl.hpp"
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

/// Takes the pairs of children whose bits are set: leaves to the leaf pairs, the others to the stack.
Ends descend(const WideWalk& walk, const TreeRefPair& pair, std::uint64_t bits, Opening opening, Ends ends,
             WalkCounts& counts) {
  const auto child = [&](WideTree& tree, const TreeRef& parent, bool is_open, int lane) {
    return is_open ? tree.child(parent.node(), lane, counts.made, walk.for_each) : parent;
  };
  for (; bits != 0; bits &= bits - 1) {
    const int bit = std::countr_zero(bits), one = bit / kWidth, lane = bit % kWidth;
    const TreeRef a = child(walk.a, pair.a, opening.a, opening.b ? one : lane),
                  b = child(walk.b, pair.b, opening.b, opening.b ? lane : one);
    const bool both_leaves = a.is_leaf() && b.is_leaf();
    // Written to both lists, and kept in one: a branch could not be predicted.
    *ends.open = {a, b};
    *ends.leaves = {&a.leaf(), &b.leaf()};
    ends.leaves += both_leaves, ends.open += !both_leaves;
  }
  return ends;
}

/// How far `advance` goes.
struct Goal {
  std::size_t leaf_pairs;
  std::uint64_t box_tests;
  [[nodiscard]] bool is_reached(const std::vector<WideLeafPair>& found, const WalkCounts& counts) const {
    return found.size() >= leaf_pairs || counts.box_tests >= box_tests;
  }
};

/// A large leaf against what is much smaller, down to the small leaves that may touch the large one's triangles, depth
/// first: each node is held against those triangles alone that met its parent's boxes. By the large leaf's own box the
/// whole node would be opened. What the goal leaves goes to the stack.
void walk_below(const WideWalk& walk, const TreeRefPair& pair, bool large_is_a, const Goal& goal, LargeLeaf& large,
                std::vector<TreeRefPair>& stack, std::vector<WideLeafPair>& leaf_pairs, WalkCounts& counts) {
  const TreeRef &leaf = large_is_a ? pair.a : pair.b, &top = large_is_a ? pair.b : pair.a;
  WideTree& tree = large_is_a ? walk.b : walk.a;
  if (!large.is(leaf.leaf(), large_is_a)) large.set(leaf.leaf(), large_is_a, walk.relation);
  struct Step {
    TreeRef ref;
    LargeLeaf::Triangles triangles;
  };
  constexpr std::size_t kMost = 64;
  Step steps[kMost];
  std::size_t size = 0;
  const auto put_back = [&](const TreeRef& ref) {
    stack.push_back(large_is_a ? TreeRefPair{leaf, ref} : TreeRefPair{ref, leaf});
  };
  steps[size++] = {top, large.all()};
  while (size > 0 && !goal.is_reached(leaf_pairs, counts)) {
    const Step step = steps[--size];
    if (step.ref.is_leaf()) {
      ++counts.box_tests;
      const WideLeaf& small = step.ref.leaf();
      if (large.meets(small, step.triangles))
        leaf_pairs.push_back(large_is_a ? WideLeafPair{&leaf.leaf(), &small} : WideLeafPair{&small, &leaf.leaf()});
      continue;
    }
    WideNode& node = step.ref.node();
    counts.box_tests += node.size;
    const LargeLeaf::Meeting meeting = large.meet(node, step.triangles);
    if (meeting.boxes == 0) continue;
    const auto add = [&](int box) {
      const TreeRef child = tree.child(node, box, counts.made, walk.for_each);
      if (size == kMost) return put_back(child);
      steps[size++] = {child, meeting.triangles};
    };
    const auto nearest = static_cast<int>(std::min_element(meeting.height, meeting.height + kWidth) - meeting.height);
    for (unsigned left = meeting.boxes & ~(1u << nearest); left != 0; left &= left - 1) add(std::countr_zero(left));
    add(nearest);
  }
  for (std::size_t i = 0; i < size; ++i) put_back(steps[i].ref);
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
  LargeLeaf large;
  const Goal goal{leaf_pairs.size() + limits.leaf_pairs, counts.box_tests + limits.box_tests};
  while (!stack.empty() && !goal.is_reached(leaf_pairs, counts)) {
    std::size_t size = std::min(stack.size(), limits.at_once);
    std::copy_n(stack.end() - static_cast<std::ptrdiff_t>(size), size, block);
    stack.resize(stack.size() - size);
    const auto is_below = [&](const TreeRefPair& pair) HWY_ATTR {
      const LargeLeaf::Side side = LargeLeaf::side_of(pair.a, pair.b, walk.relation);
      if (side == LargeLeaf::Side::none) return false;
      walk_below(walk, pair, side == LargeLeaf::Side::a, goal, large, stack, leaf_pairs, counts);
      return true;
    };
    size = static_cast<std::size_t>(std::remove_if(block, block + size, is_below) - block);
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
      ends = descend(walk, block[i], bits & ~nearest, opening, ends, counts);
      if (nearest != 0) ends = descend(walk, block[i], nearest, opening, ends, counts);
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
