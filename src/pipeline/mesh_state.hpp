// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/mesh_data.hpp"
#include "hierarchy/placed_tree.hpp"
#include "hierarchy/wide_tree.hpp"
#include "impinge/mesh.hpp"
#include "motion/features.hpp"
#include "paper/obb_tree.hpp"
#include "partition/embedded_stars.hpp"
#include "pipeline/mesh_pieces.hpp"

namespace impinge {

/// What a `Mesh` shares: its numbers, which never change, its trees, which grow as walks need them, and what was found
/// out about it.
struct MeshState : std::enable_shared_from_this<MeshState> {
  MeshState(MeshData numbers, const TreeConfig& tree_config)
      : data(std::move(numbers)),
        config(tree_config),
        tree(data, config.leaf_size > 0                    ? config.leaf_size
                   : data.triangles.size() <= kPlainDirect ? kPlainDirect
                                                           : kPlainLeafSize),
        wide_tree(data, config.leaf_size > 0 ? config.leaf_size : kWideLeafSize) {}
  /// Of the same triangles as another, whose wide tree is refitted where so much of it is made that it is worth it.
  MeshState(MeshData numbers, const MeshState& source, const ForEach& for_each)
      : data(std::move(numbers)),
        config(source.config),
        tree(data, source.tree.leaf_size()),
        wide_tree(data, config.leaf_size > 0 ? config.leaf_size : kWideLeafSize,
                  source.wide_tree.plan(kRefitted, for_each)),
        features(source.features),
        closed(source.closed) {}

  // Where the cost function is least (tests/schedule by counts, docs/performance.md by the clock). The paper's way
  // tests a mesh of up to kPlainDirect triangles directly, as one leaf. The wide tree, which measures distances too,
  // does so only up to its leaf size: beyond it collisions would gain as long as the tree is not made, and distances
  // lose.
  static constexpr std::uint32_t kPlainLeafSize = 4, kPlainDirect = 128, kWideLeafSize = 16;
  // What is not made yet has to be made for the plan of a tree, which the next meshes then share.
  static constexpr double kRefitted = 1 / 3.0;

  /// Its numbers and the fast way's tree at a pose.
  [[nodiscard]] hierarchy::PlacedTree placed(const Pose& pose) const { return {&data, &wide_tree, pose}; }

  const MeshData data;
  const TreeConfig config;
  // Safe from many threads.
  mutable paper::ObbTree tree;
  mutable hierarchy::WideTree wide_tree;
  mutable MeshPiecesCache pieces_cache;
  mutable partition::EmbeddedStarsCache stars;
  const std::shared_ptr<motion::FeaturesCache> features = std::make_shared<motion::FeaturesCache>();
  const std::shared_ptr<partition::ClosedVertices> closed = std::make_shared<partition::ClosedVertices>();
};

}  // namespace impinge
