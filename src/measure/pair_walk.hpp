// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "core/for_each.hpp"
#include "hierarchy/placed_tree.hpp"
#include "hierarchy/tree_relation.hpp"
#include "measure/lower_bounds.hpp"

namespace impinge::measure {

/// A triangle's world vertices (contract 1.1).
Triangle world_triangle(const hierarchy::PlacedTree& body, std::uint32_t triangle);

/// Two children of nodes, or leaves; no two of their points are nearer to each other than `lower`.
struct NodePair {
  static constexpr std::int8_t kSelf = -1;
  double lower;
  hierarchy::TreeRef a, b;     ///< parents, whose children are made when the pair's turn comes
  std::int8_t lane_a, lane_b;  ///< the child's lane, or kSelf for the node or leaf itself
  std::uint16_t depth;
};

/// Descends two trees together. All lengths are in the world.
class PairWalk {
 public:
  PairWalk(const hierarchy::PlacedTree& a, const hierarchy::PlacedTree& b, const ForEach& for_each = {});

  /// A is the body with the larger unit; if swapped, it is the caller's second one.
  [[nodiscard]] bool is_swapped() const { return swapped_; }
  [[nodiscard]] const hierarchy::PlacedTree& a() const { return a_; }
  [[nodiscard]] const hierarchy::PlacedTree& b() const { return b_; }

  [[nodiscard]] NodePair roots() const;
  /// Whether the bodies are so far apart compared with their sizes that the rounding of a distance is no longer small
  /// compared with the differences between distances.
  [[nodiscard]] bool are_remote() const;

  /// Replaces parents by the children in the pair's lanes, making these if need be.
  void reach(NodePair& pair) const;
  /// Appends the pairs of children that may be within the limit. The pair was reached, and not both are leaves.
  void open(const NodePair& pair, double limit, std::vector<NodePair>& children) const;
  /// Replaces the list by the pairs of triangles of two leaves that may be within the limit, or the nearest of them.
  void open_leaves(const NodePair& pair, double limit, Wanted wanted, std::vector<NearTriangles>& near) const;
  [[nodiscard]] double world_length(double lower) const { return unit_ * lower; }

 private:
  [[nodiscard]] float in_unit(double limit) const;

  bool swapped_;
  const hierarchy::PlacedTree &a_, &b_;
  double unit_;  ///< that of A
  hierarchy::TreeRelation relation_;
  ForEach for_each_;
};

}  // namespace impinge::measure
