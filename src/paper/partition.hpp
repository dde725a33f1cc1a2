// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/pose.hpp"
#include "impinge/options.hpp"
#include "paper/batch.hpp"
#include "paper/leaf_block.hpp"
#include "partition/grid.hpp"

namespace impinge::paper {

/// The two objects of a leaf pair.
struct PlacedMeshes {
  const MeshData& mesh_a;
  const Pose& pose_a;
  const MeshData& mesh_b;
  const Pose& pose_b;
};

/// Turns leaf pairs into streams: poses the leaves, lays the grid over their overlap, and lets those edges and
/// triangles go on that share a cell, each pair of them once. Keeps its scratch memory, and a leaf's posed elements as
/// long as the same leaf comes again.
class Partitioner {
 public:
  explicit Partitioner(Partition partition) : partition_(partition) {}

  /// Appends the tests of one leaf pair to the batch.
  void append(const LeafPair& pair, const PlacedMeshes& placed, Batch& batch);

  /// To be called when the batch has been cleared, or the objects change.
  void restart() { a_.leaf = b_.leaf = nullptr; }

 private:
  /// An edge or a triangle of a leaf that goes on, and the cells it was mapped to.
  struct Element {
    std::uint32_t index;
    partition::Cells cells;
  };

  /// A leaf's elements in the batch, with their world boxes.
  struct PosedLeaf {
    const LeafBlock* leaf = nullptr;
    std::uint32_t first_edge = 0, first_triangle = 0;
    std::vector<Box> edge_boxes, triangle_boxes;
    Box box{};
    std::vector<Element> edges, triangles;  ///< of the leaf pair at hand
  };

  static void pose(const LeafBlock& leaf, const MeshData& mesh, const Pose& pose, PosedLeaf& posed, Batch& batch);
  void map_to_cells(const Box& region);
  void stream(const PosedLeaf& edges, const PosedLeaf& triangles, bool edges_are_a, Batch& batch);
  std::uint32_t candidate(std::uint32_t a, std::uint32_t b, Batch& batch);

  Partition partition_;
  PosedLeaf a_, b_;
  std::vector<std::uint32_t> candidates_;  ///< of the leaf pair at hand, by (triangle of a, triangle of b)
};

}  // namespace impinge::paper
