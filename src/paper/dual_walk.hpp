// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/pose.hpp"
#include "hierarchy/walk_counts.hpp"
#include "paper/leaf_block.hpp"
#include "paper/obb_overlap.hpp"
#include "paper/obb_tree.hpp"

namespace impinge::paper {

/// A tree as placed in the world.
struct PlacedObbTree {
  ObbTree& tree;
  const MeshData& mesh;
  const Pose& pose;
};

struct NodePair {
  std::uint32_t a, b;
};

/// The walk down two trees together (figure 3 of the paper), without recursion. `stack` is what remains to be walked:
/// it may be cut up and walked in several threads.
class DualWalk {
 public:
  /// `overlap` holds whatever the two share.
  DualWalk(const PlacedObbTree& a, const PlacedObbTree& b, const Box& overlap);

  /// Prepares both roots and puts them on the stack.
  void start(std::vector<NodePair>& stack, hierarchy::WalkCounts& counts) const;

  /// Walks until the stack is empty, `max_leaf_pairs` have been appended or `max_box_tests` made.
  void advance(std::vector<NodePair>& stack, LeafPairs& leaf_pairs, std::size_t max_leaf_pairs,
               std::uint64_t max_box_tests, hierarchy::WalkCounts& counts) const;

 private:
  bool worth_splitting(const PlacedObbTree& placed, const Node& node, const Vec3& rounding) const;

  PlacedObbTree a_, b_;
  RelativePose relative_;
  Vec3 rounding_a_, rounding_b_;
  Box overlap_;
};

}  // namespace impinge::paper
