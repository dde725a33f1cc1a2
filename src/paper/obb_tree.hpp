// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/concurrent_vector.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "core/mesh_data.hpp"
#include "hierarchy/walk_counts.hpp"
#include "paper/leaf_block.hpp"
#include "paper/obb.hpp"

namespace impinge::paper {

struct Node {
  Obb box;
  std::uint32_t first = 0, count = 0;  ///< its triangles in the tree's order
  std::uint32_t depth = 0;
  std::uint32_t leaf = 0;                   ///< its block, if it is a leaf
  std::atomic<std::uint32_t> children = 0;  ///< ObbTree::kLeaf, kUnsplit, kBusy or the first of two neighbours
};

/// The paper's binary OBB tree (section 3.3), top-down. A node is split when a walk first reaches it, and stays split;
/// many walks may do so at once. Needs the mesh to outlive it.
class ObbTree {
 public:
  static constexpr std::uint32_t kUnsplit = 0, kLeaf = 0xFFFFFFFF, kBusy = 0xFFFFFFFE;
  static constexpr std::uint32_t kRoot = 0;

  ObbTree(const MeshData& mesh, std::uint32_t leaf_size) : mesh_(mesh), leaf_size_(leaf_size) {}

  /// Makes the root if there is none yet. The mesh has at least one triangle. Returns the number of nodes made. If
  /// memory runs out, here or below, the exception passes and the tree is as it was.
  void prepare(hierarchy::MadeNodes& made);

  [[nodiscard]] const Node& node(std::uint32_t index) const { return nodes_[index]; }
  [[nodiscard]] const LeafBlock& block(const Node& leaf) const { return blocks_[leaf.leaf]; }
  [[nodiscard]] static bool is_leaf(const Node& node) { return node.children.load(std::memory_order_acquire) == kLeaf; }
  [[nodiscard]] static bool is_split(const Node& node) {
    const std::uint32_t c = node.children.load(std::memory_order_acquire);
    return c != kUnsplit && c != kBusy && c != kLeaf;
  }

  /// The first of a node's two children, made now if need be (`made` counts both then). The node is not a leaf.
  std::uint32_t children(std::uint32_t index, hierarchy::MadeNodes& made);

  [[nodiscard]] std::uint32_t leaf_size() const { return leaf_size_; }
  [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }
  /// What the tree holds in memory now.
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// What a node is made of, before it is one: all that may run out of memory happens first.
  struct Draft {
    Obb box;
    std::uint32_t first, count, depth, leaf;
  };

  std::uint32_t split(const Node& node);
  std::uint32_t partition(const Node& node);
  Draft draft(std::uint32_t first, std::uint32_t count, std::uint32_t depth);
  void publish(const Draft& draft, Node& node) const;

  const MeshData& mesh_;
  std::uint32_t leaf_size_;
  std::once_flag root_made_;
  std::vector<std::uint32_t> order_;  ///< a permutation of the triangles; a node's range is permuted by its split alone
  tbb::concurrent_vector<Node> nodes_;  ///< grows under concurrent reads, elements never move
  tbb::concurrent_vector<LeafBlock> blocks_;
};

}  // namespace impinge::paper
