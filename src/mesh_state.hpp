// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/mesh_data.hpp"
#include "hierarchy/obb_tree.hpp"
#include "impinge/mesh.hpp"

namespace impinge {

/// What a `Mesh` shares: its numbers, which never change, and its tree, which grows as walks need it.
struct MeshState {
  MeshState(MeshData numbers, const TreeConfig& tree_config)
      : data(std::move(numbers)), config(tree_config), tree(data, config.leaf_size) {}

  const MeshData data;
  const TreeConfig config;
  mutable hierarchy::ObbTree tree;  ///< safe from many threads
};

}  // namespace impinge
