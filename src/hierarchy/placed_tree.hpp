// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/mesh_data.hpp"
#include "hierarchy/wide_tree.hpp"
#include "impinge/mesh.hpp"

namespace impinge::hierarchy {

/// A mesh at a valid pose, with its tree, which grows as walks need it.
struct PlacedTree {
  const MeshData* mesh;
  WideTree* tree;
  Pose pose;
};

}  // namespace impinge::hierarchy
