// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <optional>
#include <string>
#include <vector>

#include "broad/near_pairs.hpp"
#include "impinge/scene.hpp"
#include "pipeline/domain_error.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/query.hpp"
#include "scene/placed_block.hpp"
#include "scene/scene_view.hpp"

namespace impinge {

struct Scene::State {
  State() {
    static std::atomic<std::uint32_t> scenes{0};
    first_generation = 0x9E3779B1u * ++scenes;  // odd: no two of 2^32 scenes have the same
  }

  /// Where a motion starts.
  struct Start {
    Mesh mesh;
    Pose pose;
  };
  /// A place for an object, occupied or free.
  struct Slot {
    std::optional<Mesh> mesh;
    std::uint32_t generation;
    std::optional<Start> start{};  ///< as long as there is a mesh
  };

  // All by the object's index.
  std::vector<Slot> slots;
  std::vector<scene::PlacedObject> objects;
  std::vector<const MeshState*> meshes;

  std::uint32_t first_generation;  ///< of each index; differs from scene to scene, so that a foreign id is unknown
  std::vector<std::uint32_t> free_slots;
  std::size_t outside_exact_domain = 0;  ///< how many objects are
  scene::IgnoredPairs ignored;
  broad::ObjectPairs own_pairs;  ///< objects that are tested against themselves, in order
  broad::NearPairs near_pairs;

  [[nodiscard]] bool has(ObjectId id) const {
    return id.index < slots.size() && slots[id.index].generation == id.generation && slots[id.index].mesh;
  }
  [[nodiscard]] Result<void> check(ObjectId id) const {
    if (has(id)) return {};
    if (id == ObjectId{}) return Error{Code::unknown_id, "the id is that of no object: Scene::add gives one"};
    return Error{Code::unknown_id, "there is no object " + std::to_string(id.index) +
                                       " with this id in this scene; it was removed, or belongs to another scene"};
  }

  /// Room for so many objects, which nothing but a larger scene needs memory for.
  void reserve(std::size_t room) {
    objects.reserve(room), meshes.reserve(room), slots.reserve(room), free_slots.reserve(room);
    near_pairs.reserve(room);
  }
  /// Makes a free slot. Room for every list comes first, so that they stay of one length if memory runs out.
  void grow() {
    const std::size_t n = slots.size() + 1;
    reserve(std::bit_ceil(n));
    objects.emplace_back(), meshes.push_back(nullptr), slots.push_back({{}, first_generation});
    free_slots.push_back(static_cast<std::uint32_t>(n - 1));
  }

  /// Whether contacts and distances of all objects are exact.
  [[nodiscard]] Result<void> check_domain() const {
    if (outside_exact_domain == 0) return {};
    for (std::size_t i = 0; i < objects.size(); ++i)
      if (!objects[i].in_domain) return not_in_range("object " + std::to_string(i));
    return {};
  }
  /// Puts an object, or nothing, where another one or nothing was.
  void put(std::uint32_t index, const MeshState* mesh, const scene::PlacedObject& placed) {
    outside_exact_domain += int{placed.is_outside_exact_domain} - int{objects[index].is_outside_exact_domain};
    objects[index] = placed, meshes[index] = mesh;
    near_pairs.place(index, placed);
  }
  void set_self(std::uint32_t index, bool on) {
    std::erase(own_pairs, broad::ObjectPair{index, index});
    const auto is_later = [index](const broad::ObjectPair& pair) { return pair.a > index; };
    if (on) own_pairs.insert(std::find_if(own_pairs.begin(), own_pairs.end(), is_later), {index, index});
  }
  /// Moves objects to where the members of the block are, valid ones of their meshes.
  void move(std::span<const ObjectId> ids, const scene::PlacedBlock& block) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      scene::PlacedObject& object = objects[ids[i].index];
      outside_exact_domain -= int{object.is_outside_exact_domain};
      block.write(i, object);
      outside_exact_domain += int{object.is_outside_exact_domain};
    }
    // Not at once: what has just been written number by number cannot be read in larger pieces yet.
    for (const ObjectId& id : ids) near_pairs.place(id.index, objects[id.index]);
  }
  /// Whether two objects are tested against each other.
  [[nodiscard]] bool are_tested(std::uint32_t a, std::uint32_t b) const { return view().are_tested(a, b); }
  /// The keys of the objects that are tested against each other and whose boxes, which are by object, overlap, sorted.
  [[nodiscard]] std::vector<std::uint64_t> overlapping(std::span<const Box> boxes) const {
    std::vector<broad::BoxTree::Entry> entries;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      if (!is_empty(boxes[i])) entries.emplace_back(boxes[i], i);
    broad::BoxTree tree;
    tree.build(entries);
    broad::BoxTree::Search search;
    std::vector<std::uint32_t> groups;
    for (const scene::PlacedObject& object : objects) groups.push_back(object.group);
    tree.find_pairs(boxes, groups, search);
    std::erase_if(search.found, [this](std::uint64_t key) {
      return ignored.contains(static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key));
    });
    std::sort(search.found.begin(), search.found.end());
    return std::move(search.found);
  }
  [[nodiscard]] PlacedMesh placed(std::uint32_t object) const { return {objects[object], *meshes[object]}; }
  [[nodiscard]] scene::SceneView view() const { return {objects, &ignored}; }
};

/// A scene's near pairs, or, where they are not current, a copy that is.
class CurrentPairs {
 public:
  CurrentPairs(const broad::NearPairs& kept, int threads) : kept_(kept) {
    if (!kept.is_current()) updated_.emplace(kept).update(on_threads(threads));
  }
  const broad::NearPairs& operator*() const { return updated_ ? *updated_ : kept_; }

 private:
  const broad::NearPairs& kept_;
  std::optional<broad::NearPairs> updated_;
};

}  // namespace impinge
