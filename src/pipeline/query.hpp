// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "broad/near_pairs.hpp"
#include "broad/object_pairs.hpp"
#include "impinge/options.hpp"
#include "pipeline/mesh_state.hpp"
#include "scene/scene_view.hpp"

namespace impinge {

/// An object and its mesh.
struct PlacedMesh {
  const scene::PlacedObject& object;
  const MeshState& mesh;
};

/// A question to the pipeline.
struct Query {
  scene::SceneView view;
  std::span<const MeshState* const> meshes;  ///< an object's, null where its mesh is
  const broad::NearPairs* near_pairs;        ///< current, unless by the paper's way; used without `pairs`
  const broad::ObjectPairs* pairs;           ///< what is asked about; null: the broad phase finds them
  bool all_rows;                             ///< a row for each of the pairs, touching or not
  const Options& options;
  std::span<const broad::ObjectPair> own_pairs{};  ///< an object and itself: beside what the broad phase finds

  [[nodiscard]] PlacedMesh placed(std::uint32_t object) const { return {view.objects[object], *meshes[object]}; }
};

}  // namespace impinge
