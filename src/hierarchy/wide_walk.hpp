// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy/tree_relation.hpp"
#include "hierarchy/walk_counts.hpp"
#include "hierarchy/wide_tree.hpp"

namespace impinge::hierarchy {

struct TreeRefPair {
  TreeRef a, b;
};

/// How far to walk in one go, and in what order.
struct WalkLimits {
  static constexpr std::size_t kMostAtOnce = 32;
  std::size_t leaf_pairs;             ///< stop after so many
  std::uint64_t box_tests;            ///< stop after so many
  std::size_t at_once = kMostAtOnce;  ///< pairs of nodes taken off the stack together
  /// Of each pair's children, first the two whose boxes' centres are closest. (Of a node below a large leaf the child
  /// whose centre is closest to the plane of a triangle that may meet its box always comes first.)
  bool nearest_first = false;
};

/// The walk down two wide trees together: eight boxes against eight at a time, without recursion. What remains to be
/// walked is on the stack, which may be cut up and walked in several threads.
struct WideWalk {
  WideTree& a;
  WideTree& b;
  TreeRelation relation;  ///< of b to a
  ForEach for_each{};     ///< shares the making of large nodes
  bool is_self = false;   ///< both are one tree in one place: each two nodes are met in one order

  /// Prepares both roots and puts them on the stack.
  void start(std::vector<TreeRefPair>& stack, WalkCounts& counts) const;

  /// Walks until the stack is empty or a limit is reached. The leaf pairs come after those that are there.
  void advance(std::vector<TreeRefPair>& stack, std::vector<WideLeafPair>& leaf_pairs, const WalkLimits& limits,
               WalkCounts& counts) const;
};

}  // namespace impinge::hierarchy
