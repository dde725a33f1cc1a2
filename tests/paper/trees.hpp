// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <bit>

#include "paper/obb_tree.hpp"
#include "tests/core/support.hpp"

namespace impinge::test {

/// Splits every node and holds the tree against its promises: each triangle in exactly one leaf, leaves no larger than
/// asked for, depth bounded, no node without triangles. Returns the number of nodes.
inline std::size_t expect_whole_tree(const MeshData& mesh, std::uint32_t leaf_size) {
  paper::ObbTree tree(mesh, leaf_size);
  const auto n = static_cast<std::uint32_t>(mesh.triangles.size());
  hierarchy::MadeNodes made;
  tree.prepare(made), tree.prepare(made);
  EXPECT_EQ(made.nodes, 1u);
  EXPECT_EQ(made.triangles, n);
  const std::uint32_t deepest = 40 + std::bit_width(n) + 1;
  std::vector<std::uint32_t> times_in_leaf(n);
  std::vector<std::uint32_t> open{paper::ObbTree::kRoot};
  std::size_t nodes = 0, triangles = 0;
  while (!open.empty()) {
    const std::uint32_t index = open.back();
    open.pop_back();
    ++nodes, triangles += tree.node(index).count;
    const paper::Node& node = tree.node(index);
    EXPECT_GT(node.count, 0u);
    EXPECT_LE(node.depth, deepest);
    if (paper::ObbTree::is_leaf(node)) {
      EXPECT_LE(node.count, leaf_size);
      EXPECT_EQ(tree.block(node).triangles.size(), node.count);
      for (const std::uint32_t t : tree.block(node).triangles) ++times_in_leaf[t];
      continue;
    }
    EXPECT_GT(node.count, leaf_size);
    EXPECT_FALSE(paper::ObbTree::is_split(node));
    const std::uint32_t child = tree.children(index, made);
    EXPECT_TRUE(paper::ObbTree::is_split(node));
    EXPECT_EQ(tree.children(index, made), child);
    EXPECT_EQ(tree.node(child).count + tree.node(child + 1).count, node.count);
    open.insert(open.end(), {child, child + 1});
    if (testing::Test::HasFailure()) return nodes;
  }
  EXPECT_EQ(nodes, made.nodes);
  EXPECT_EQ(triangles, made.triangles);
  EXPECT_EQ(nodes, tree.node_count());
  EXPECT_EQ(times_in_leaf, std::vector<std::uint32_t>(n, 1));
  return nodes;
}

}  // namespace impinge::test
