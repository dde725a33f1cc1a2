// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "clash/defects.hpp"
#include "core/mesh_data.hpp"
#include "hierarchy/wide_tree.hpp"
#include "impinge/mesh.hpp"
#include "paper/obb_tree.hpp"

namespace impinge {

/// What a `Mesh` shares: its numbers, which never change, its trees, which grow as walks need them, and what was found
/// out about it.
struct MeshState : std::enable_shared_from_this<MeshState> {
  MeshState(MeshData numbers, const TreeConfig& tree_config)
      : data(std::move(numbers)),
        config(tree_config),
        tree(data, config.leaf_size > 0 ? config.leaf_size : kPlainLeafSize),
        wide_tree(data, config.leaf_size > 0 ? config.leaf_size : kWideLeafSize) {}

  // What is fastest (docs/performance.md).
  static constexpr std::uint32_t kPlainLeafSize = 4, kWideLeafSize = 16;

  const MeshData data;
  const TreeConfig config;
  // Safe from many threads.
  mutable paper::ObbTree tree;
  mutable hierarchy::WideTree wide_tree;
  mutable clash::DefectCache defect_cache;
};

}  // namespace impinge
