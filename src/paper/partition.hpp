// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/pose.hpp"
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

/// Turns leaf pairs into streams: poses the leaves, lays the grid over their overlap, sorts edges and triangles into
/// its cells, and makes tests of those that share one, each once. Keeps its scratch memory, and leaves that were posed
/// as long as the batch is not cleared.
class Partitioner {
 public:
  /// Appends the tests of one leaf pair to the batch.
  void append(const LeafPair& pair, const PlacedMeshes& placed, Batch& batch);

  /// To be called when the batch has been cleared, or the objects change.
  void restart();

  /// How many pairs of an edge and a triangle have shared a cell, whether their boxes met or not.
  [[nodiscard]] std::uint64_t shared_cells() const { return shared_cells_; }

 private:
  /// A leaf whose elements are in the batch.
  struct PosedLeaf {
    const LeafBlock* leaf = nullptr;
    std::uint32_t first_edge = 0, first_triangle = 0;
    Box box{};  ///< in the world
  };
  /// Posed leaves of one object, each in the place that its address gives it until another one takes it.
  using PosedLeaves = std::array<PosedLeaf, 64>;

  /// An edge or a triangle of a leaf, and the cells that it is in.
  struct Element {
    std::uint32_t index;
    partition::Cells cells;
  };
  struct Elements {
    std::vector<Element> edges, triangles;
  };

  const PosedLeaf& posed(PosedLeaves& leaves, const LeafBlock& leaf, const MeshData& mesh, const Pose& pose,
                         Batch& batch);
  void sort_into_cells(const PosedLeaf& a, const PosedLeaf& b);
  void stream(bool edges_are_a, const PosedLeaf& a, const PosedLeaf& b, Batch& batch);
  std::uint32_t candidate(const PosedLeaf& a, std::uint32_t ta, const PosedLeaf& b, std::uint32_t tb, Batch& batch);

  std::uint64_t shared_cells_ = 0;
  PosedLeaves posed_a_, posed_b_;
  std::vector<Box> edge_boxes_, triangle_boxes_;  ///< of the batch's
  // Of the leaf pair at hand:
  Elements in_a_, in_b_;
  std::array<std::uint64_t, 64> edges_of_cells_{};  ///< a set of edges each, a bit for an edge
  std::vector<std::uint32_t> candidates_;           ///< by (triangle of a, triangle of b)
};

}  // namespace impinge::paper
