// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/scene.hpp"

#include <optional>

#include "core/guarded.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/scene_state.hpp"
#include "pipeline/workspace_state.hpp"
#include "scene/validate_pose.hpp"

namespace impinge {
Scene::Scene() : state_(std::make_unique<State>()) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

Result<ObjectId> Scene::add(Mesh mesh, const Pose& pose, std::uint32_t group) {
  return guarded([&]() -> Result<ObjectId> {
    if (auto valid = scene::validate(pose); !valid) return valid.error();
    State& s = *state_;
    if (s.free_slots.empty()) s.grow();
    const std::uint32_t index = s.free_slots.back();
    s.free_slots.pop_back();
    const MeshState& mesh_state = mesh.state();
    s.objects[index] = scene::place(mesh_state.data, pose, group);
    s.meshes[index] = &mesh_state;
    s.slots[index].mesh = std::move(mesh);
    s.near_pairs.place(index, s.objects[index]);
    return ObjectId{index, s.slots[index].generation};
  });
}

Result<void> Scene::set_pose(ObjectId id, const Pose& pose) {
  const FloatEnvironment nearest;
  State& s = *state_;
  if (auto known = s.check(id); !known) return known;
  if (auto valid = scene::validate(pose); !valid) return valid;
  scene::PlacedObject& object = s.objects[id.index];
  object = scene::place(s.slots[id.index].mesh->state().data, pose, object.group);
  s.near_pairs.place(id.index, object);
  return {};
}

Result<void> Scene::set_mesh(ObjectId id, Mesh mesh, const Pose& pose) {
  const FloatEnvironment nearest;
  State& s = *state_;
  if (auto known = s.check(id); !known) return known;
  if (auto valid = scene::validate(pose); !valid) return valid;
  const MeshState& mesh_state = mesh.state();
  s.objects[id.index] = scene::place(mesh_state.data, pose, s.objects[id.index].group);
  s.meshes[id.index] = &mesh_state;
  s.slots[id.index].mesh = std::move(mesh);
  s.near_pairs.place(id.index, s.objects[id.index]);
  return {};
}

Result<void> Scene::remove(ObjectId id) {
  State& s = *state_;
  if (auto known = s.check(id); !known) return known;
  s.slots[id.index].mesh.reset();
  ++s.slots[id.index].generation;
  s.objects[id.index] = {};
  s.meshes[id.index] = nullptr;
  s.ignored.erase_all_of(id.index);
  s.near_pairs.place(id.index, s.objects[id.index]);
  s.free_slots.push_back(id.index);
  return {};
}

Result<void> Scene::ignore(ObjectId a, ObjectId b) {
  return guarded([&]() -> Result<void> {
    for (const ObjectId id : {a, b})
      if (auto known = state_->check(id); !known) return known;
    if (a == b) return Error{Code::bad_option, "an object is never tested against itself; name two objects"};
    state_->ignored.insert(a.index, b.index);
    return {};
  });
}

Result<void> Scene::unignore(ObjectId a, ObjectId b) {
  for (const ObjectId id : {a, b})
    if (auto known = state_->check(id); !known) return known;
  state_->ignored.erase(a.index, b.index);
  return {};
}

std::size_t Scene::size() const noexcept { return state_->slots.size() - state_->free_slots.size(); }

Result<Pose> Scene::pose(ObjectId id) const {
  if (auto known = state_->check(id); !known) return known.error();
  return state_->objects[id.index].pose;
}

Result<void> Scene::update(int threads) {
  return guarded([&]() -> Result<void> {
    if (auto valid = validate(Options{.threads = threads}); !valid) return valid;
    state_->near_pairs.update(on_threads(threads));
    return {};
  });
}

Result<Contacts> Scene::collide(const Options& options, Workspace* workspace) const {
  return guarded([&]() -> Result<Contacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    const State& s = *state_;
    std::optional<broad::NearPairs> updated;
    if (!s.near_pairs.is_current() && !is_papers_way(options))
      updated.emplace(s.near_pairs).update(on_threads(options.threads));
    const broad::NearPairs& near_pairs = updated ? *updated : s.near_pairs;
    return run_pipeline({s.view(), s.meshes, &near_pairs, nullptr, false, options}, *QueryMemory(workspace));
  });
}

}  // namespace impinge
