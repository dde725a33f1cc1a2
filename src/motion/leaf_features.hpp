// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "motion/features.hpp"
#include "motion/path_tree.hpp"

namespace impinge::motion {

/// The features of eight triangles with their boxes: all faces, and of vertices and edges those in their care. They lie
/// in blocks, feature i in block i / 16. Most leaves have eight vertices or fewer, and no more than sixteen edges: that
/// is in the first two blocks.
struct LeafFeatures {
  static constexpr int kMost = 3 * kWidth;
  static constexpr int kBlock = 16, kBlocks = 4;
  static constexpr int kVertices = kWidth, kEdges = kBlock, kOtherVertices = 3 * kBlock;  ///< the first of each kind
  struct Block {
    PathBoxes<kBlock> boxes;
    std::uint32_t vertices[3][kBlock];  ///< of an edge the second one twice, of a vertex itself
    std::uint32_t index[kBlock];
  };
  Block blocks[kBlocks];
  /// A bit for each feature.
  std::uint64_t all;
  static constexpr std::uint64_t kFaceBits = (std::uint64_t{1} << kVertices) - 1,
                                 kEdgeBits = ((std::uint64_t{1} << kMost) - 1) << kEdges,
                                 kVertexBits = ~(kFaceBits | kEdgeBits);
  PathBoxes<1> box;  ///< of all

  void read(const PathTree& tree, const Features& features, std::size_t leaf);
};

/// Pairs of features by their indices, for each kind a list; a vertex stands before a face.
struct FeaturePairs {
  static constexpr std::size_t kRoom = 1024;
  /// That two leaves may add.
  static constexpr std::size_t kMost = std::size_t{LeafFeatures::kMost} * LeafFeatures::kMost;
  struct List {
    std::array<std::uint32_t, 2> pairs[kRoom];
    std::size_t count = 0;
  };
  List lists[3];  ///< by `Feature`
};

/// What is looked for: what comes within `reach`, in the unit of the boxes, until that part of their time, 1 for all.
struct Sought {
  float reach = 0, until = 1;
};

/// Bit 8 i + j: whether box i of one node and box j of the other may come so near.
std::uint64_t may_meet(const PathTree::Node& a, const PathTree::Node& b, Sought sought);

/// Whose leaves they are.
enum class Leaves : std::uint8_t { of_two_meshes, of_one_mesh, the_same };

/// Adds the pairs of features whose boxes may come so near. Of one mesh, pairs with a common vertex are left out, and a
/// face and a vertex count as a vertex and a face.
void add_pairs(const LeafFeatures& a, const LeafFeatures& b, Leaves leaves, Sought sought, FeaturePairs& pairs);

}  // namespace impinge::motion
