// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <optional>
#include <string>
#include <vector>

#include "broad/near_pairs.hpp"
#include "impinge/scene.hpp"
#include "pipeline/mesh_state.hpp"
#include "scene/scene_view.hpp"

namespace impinge {

struct Scene::State {
  /// A place for an object, occupied or free.
  struct Slot {
    std::optional<Mesh> mesh;
    std::uint32_t generation = 0;
  };

  // All by the object's index.
  std::vector<Slot> slots;
  std::vector<scene::PlacedObject> objects;
  std::vector<const MeshState*> meshes;

  std::vector<std::uint32_t> free_slots;
  scene::IgnoredPairs ignored;
  broad::NearPairs near_pairs;

  [[nodiscard]] Result<void> check(ObjectId id) const {
    if (id.index < slots.size() && slots[id.index].mesh && slots[id.index].generation == id.generation) return {};
    return Error{Code::unknown_id, "there is no object " + std::to_string(id.index) + " of generation " +
                                       std::to_string(id.generation) +
                                       " in this scene; it was removed, or belongs to another scene"};
  }

  /// Makes a free slot. Room for every list comes first, so that they stay of one length if memory runs out.
  void grow() {
    const std::size_t n = slots.size() + 1;
    const std::size_t room = std::bit_ceil(n);
    objects.reserve(room), meshes.reserve(room), slots.reserve(room), free_slots.reserve(room);
    near_pairs.reserve(room);
    objects.emplace_back(), meshes.push_back(nullptr), slots.emplace_back();
    free_slots.push_back(static_cast<std::uint32_t>(n - 1));
  }

  [[nodiscard]] scene::SceneView view() const { return {objects, &ignored}; }
};

}  // namespace impinge
