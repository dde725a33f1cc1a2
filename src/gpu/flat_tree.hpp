// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/for_each.hpp"
#include "core/vec3.hpp"
#include "gpu/layout.h"
#include "hierarchy/wide_tree.hpp"

namespace impinge::gpu {

/// A whole tree in two arrays. Its numbers are the tree's, rounded where a float cannot hold them; what that adds to
/// any error is in `reach`.
struct FlatTree {
  std::vector<DeviceNode> nodes;
  std::vector<DeviceLeaf> leaves;
  uint root;             ///< references are as in DeviceNode, counted from this tree's first node and leaf
  Vec3 base;             ///< the origin of the root, from which the others are counted, in the tree's unit
  double reach;          ///< the farthest of those, in the largest coordinate
  std::uint32_t levels;  ///< steps that a walk takes from the root to the deepest leaf, at most
  /// Nodes and leaves by their address, sorted.
  std::vector<std::pair<const void*, uint>> places;
};

/// Makes all of the tree that is not made yet.
FlatTree flatten(hierarchy::WideTree& tree, const ForEach& for_each);

/// The same references counted from elsewhere.
inline uint moved(uint reference, uint first_node, uint first_leaf) {
  return (reference & kLeafBit) != 0 ? reference + first_leaf : reference + first_node;
}

}  // namespace impinge::gpu
