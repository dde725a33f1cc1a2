// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/dual_walk.hpp"

namespace impinge::paper {

DualWalk::DualWalk(const PlacedObbTree& a, const PlacedObbTree& b, const Box& overlap)
    : a_(a),
      b_(b),
      relative_(a.pose, a.mesh, b.pose, b.mesh),
      rounding_a_(rounding_radius(a.pose, a.mesh)),
      rounding_b_(rounding_radius(b.pose, b.mesh)),
      overlap_(overlap) {}

void DualWalk::start(std::vector<NodePair>& stack, hierarchy::WalkCounts& counts) const {
  a_.tree.prepare(counts.made), b_.tree.prepare(counts.made);
  stack.push_back({ObbTree::kRoot, ObbTree::kRoot});
}

/// Children are built only in the potential region: a node that does not reach the overlap of the two objects shares no
/// point there, so it need not be split, nor its pair walked on. Nodes that are split already are not held against it
/// again.
bool DualWalk::worth_splitting(const PlacedObbTree& placed, const Node& node, const Vec3& rounding) const {
  return ObbTree::is_split(node) || may_reach(node.box, placed.pose, rounding, overlap_);
}

void DualWalk::advance(std::vector<NodePair>& stack, LeafPairs& leaf_pairs, std::size_t max_leaf_pairs,
                       std::uint64_t max_box_tests, hierarchy::WalkCounts& counts) const {
  const std::size_t enough = leaf_pairs.size() + max_leaf_pairs;
  const std::uint64_t last_test = counts.box_tests + max_box_tests;
  std::uint32_t moved_node = ObbTree::kLeaf;  // of B; pairs with the same one often follow each other
  Obb moved_box;
  while (!stack.empty() && leaf_pairs.size() < enough && counts.box_tests < last_test) {
    const NodePair pair = stack.back();
    stack.pop_back();
    const Node& a = a_.tree.node(pair.a);
    const Node& b = b_.tree.node(pair.b);
    ++counts.box_tests;
    if (moved_node != pair.b) {
      moved_node = pair.b;
      moved_box = relative_.moved(b.box);
    }
    if (!may_overlap(a.box, moved_box, relative_.margin)) continue;

    const bool a_leaf = ObbTree::is_leaf(a), b_leaf = ObbTree::is_leaf(b);
    if (a_leaf && b_leaf) {
      leaf_pairs.push_back({&a_.tree.block(a), &b_.tree.block(b)});
    } else if (b_leaf || (!a_leaf && dot(a.box.half, a.box.half) >= dot(b.box.half, b.box.half))) {
      if (!worth_splitting(a_, a, rounding_a_)) continue;
      const std::uint32_t child = a_.tree.children(pair.a, counts.made);
      stack.push_back({child + 1, pair.b});
      stack.push_back({child, pair.b});
    } else {
      if (!worth_splitting(b_, b, rounding_b_)) continue;
      const std::uint32_t child = b_.tree.children(pair.b, counts.made);
      stack.push_back({pair.a, child + 1});
      stack.push_back({pair.a, child});
    }
  }
}

}  // namespace impinge::paper
