// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/scene.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "broad/may_touch.hpp"
#include "core/guarded.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/options.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/scene_state.hpp"
#include "pipeline/workspace_state.hpp"
#include "scene/validate_pose.hpp"

namespace impinge {
namespace {

/// The index of a mesh that is no object of the scene.
constexpr std::uint32_t kGuest = 0xFFFFFFFF;

/// The contacts of one placed mesh with the scene's objects. The pipeline gets only those near it, renumbered in the
/// scene's order.
Result<Contacts> collide_one(const Scene::State& scene, const PlacedMesh& one, std::uint32_t index,
                             const Options& options, Workspace* workspace) {
  if (auto valid = scene.check_domain(); !valid) return valid.error();
  if (!one.object.in_domain) return not_in_range("the mesh");
  const QueryMemory memory(workspace);
  broad::BoxTree::Search& near = memory->near_pairs.jumping;
  (*CurrentPairs(scene.near_pairs, options.threads)).find_near(one.object.box, near);
  std::vector<std::uint64_t>& indices = near.found;
  std::erase_if(indices, [&](std::uint64_t object) {
    return index != kGuest && (object == index || !scene.are_tested(index, static_cast<std::uint32_t>(object)));
  });
  indices.push_back(index);
  std::sort(indices.begin(), indices.end());
  memory->placed.clear(), memory->meshes.clear(), memory->pairs.clear();
  const auto at = static_cast<std::uint32_t>(std::find(indices.begin(), indices.end(), index) - indices.begin());
  for (std::uint32_t i = 0; i < indices.size(); ++i) {
    memory->placed.push_back(i == at ? one.object : scene.objects[indices[i]]);
    memory->placed.back().group = 0;
    memory->meshes.push_back(i == at ? &one.mesh : scene.meshes[indices[i]]);
  }
  const scene::SceneView view{memory->placed, nullptr};
  for (std::uint32_t i = 0; i < indices.size(); ++i)
    if (i != at && broad::may_touch(view, i, at)) memory->pairs.push_back({std::min(i, at), std::max(i, at)});
  auto contacts = run_pipeline({view, memory->meshes, nullptr, &memory->pairs, false, options}, *memory);
  if (contacts)
    for (auto& [a, b] : contacts->objects)
      a = static_cast<std::uint32_t>(indices[a]), b = static_cast<std::uint32_t>(indices[b]);
  return contacts;
}

}  // namespace

Scene::Scene() : state_(std::make_unique<State>()) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::Scene(const Scene& other) : state_(std::make_unique<State>(*other.state_)) {
  state_->reserve(state_->slots.size());  // copied lists have no more room than they need
}
Scene& Scene::operator=(const Scene& other) { return *this = Scene(other); }

Result<ObjectId> Scene::add(Mesh mesh, const Pose& pose, std::uint32_t group) {
  return guarded([&]() -> Result<ObjectId> {
    if (auto valid = scene::validate(pose); !valid) return valid.error();
    State& s = *state_;
    if (s.free_slots.empty()) s.grow();
    const std::uint32_t index = s.free_slots.back();
    s.free_slots.pop_back();
    const MeshState& mesh_state = mesh.state();
    s.put(index, &mesh_state, scene::place(mesh_state.data, pose, group));
    s.slots[index].start = {mesh, pose};
    s.slots[index].mesh = std::move(mesh);
    return ObjectId{index, s.slots[index].generation};
  });
}

Result<void> Scene::set_pose(ObjectId id, const Pose& pose) {
  const FloatEnvironment nearest;
  State& s = *state_;
  if (auto known = s.check(id); !known) return known;
  scene::PlacedBlock block;
  block.add(s.meshes[id.index]->data, pose), block.compute();
  if (!block.is_valid(0))
    if (auto valid = scene::validate(pose); !valid) return valid;
  s.move({&id, 1}, block);
  return {};
}

Result<void> Scene::set_poses(std::span<const ObjectId> ids, std::span<const Pose> poses) {
  const FloatEnvironment nearest;
  State& s = *state_;
  if (ids.size() != poses.size())
    return Error{Code::bad_option, "there are " + std::to_string(ids.size()) + " ids and " +
                                       std::to_string(poses.size()) + " poses; give as many of both"};
  constexpr std::size_t kAtOnce = scene::PlacedBlock::kMost;
  scene::PlacedBlock block;
  const auto size_from = [&](std::size_t begin) { return std::min(kAtOnce, ids.size() - begin); };
  const auto is_good = [&](std::size_t begin) {
    block.clear();
    for (std::size_t i = begin; i < begin + size_from(begin); ++i) {
      if (!s.has(ids[i])) return false;
      block.add(s.meshes[ids[i].index]->data, poses[i]);
    }
    block.compute();
    bool all_valid = true;
    for (std::size_t i = 0; i < block.size(); ++i) all_valid &= block.is_valid(i);
    return all_valid;
  };
  // All are looked at before any is moved; a single block is then known.
  bool all_good = true;
  for (std::size_t begin = 0; begin < ids.size(); begin += kAtOnce) all_good = all_good && is_good(begin);
  for (std::size_t i = 0; i < ids.size() && !all_good; ++i) {
    const auto at = [i](const char* list, const Error& error) {
      return Error{error.code, list + ("[" + std::to_string(i) + "]: ") + error.message};
    };
    if (auto known = s.check(ids[i]); !known) return at("ids", known.error());
    if (auto valid = scene::validate(poses[i]); !valid) return at("poses", valid.error());
  }
  for (std::size_t begin = 0; begin < ids.size(); begin += kAtOnce) {
    if (ids.size() > kAtOnce || !all_good) static_cast<void>(is_good(begin));
    s.move(ids.subspan(begin, size_from(begin)), block);
  }
  return {};
}

Result<void> Scene::set_mesh(ObjectId id, Mesh mesh, const Pose& pose) {
  const FloatEnvironment nearest;
  State& s = *state_;
  if (auto known = s.check(id); !known) return known;
  if (auto valid = scene::validate(pose); !valid) return valid;
  const MeshState& mesh_state = mesh.state();
  s.put(id.index, &mesh_state, scene::place(mesh_state.data, pose, s.objects[id.index].group));
  s.slots[id.index].mesh = std::move(mesh);
  return {};
}

Result<void> Scene::set_vertices(ObjectId id, std::span<const double> xyz) {
  if (auto known = state_->check(id); !known) return known;
  auto mesh = state_->slots[id.index].mesh->deformed(xyz);
  if (!mesh) return mesh.error();
  return set_mesh(id, *std::move(mesh), state_->objects[id.index].pose);
}

Result<void> Scene::remove(ObjectId id) {
  State& s = *state_;
  if (auto known = s.check(id); !known) return known;
  s.slots[id.index].mesh.reset(), s.slots[id.index].start.reset();
  s.set_self(id.index, false);
  ++s.slots[id.index].generation;
  s.put(id.index, nullptr, {});
  s.ignored.erase_all_of(id.index);
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

Result<void> Scene::set_filter(ObjectId id, const Filter& filter) {
  return guarded([&]() -> Result<void> {
    if (auto known = state_->check(id); !known) return known;
    state_->ignored.set_filter(id.index, filter);
    return {};
  });
}

Result<void> Scene::self(ObjectId id, bool on) {
  return guarded([&]() -> Result<void> {
    if (auto known = state_->check(id); !known) return known;
    state_->set_self(id.index, on);
    return {};
  });
}

std::size_t Scene::size() const noexcept { return state_->slots.size() - state_->free_slots.size(); }

Result<ObjectId> Scene::id(std::uint32_t index) const {
  const State& s = *state_;
  if (index >= s.slots.size() || !s.slots[index].mesh)
    return Error{Code::unknown_id, "there is no object " + std::to_string(index) + " in this scene"};
  return ObjectId{index, s.slots[index].generation};
}

Result<Pose> Scene::pose(ObjectId id) const {
  if (auto known = state_->check(id); !known) return known.error();
  return state_->objects[id.index].pose;
}

void Scene::step() noexcept {
  for (std::size_t i = 0; i < state_->slots.size(); ++i)
    if (State::Slot& slot = state_->slots[i]; slot.mesh) slot.start = {*slot.mesh, state_->objects[i].pose};
}

Result<void> Scene::update(int threads) {
  return guarded([&]() -> Result<void> {
    if (threads < 0) return validate(Options{.threads = threads});
    state_->near_pairs.update(on_threads(threads));
    return {};
  });
}

Result<Contacts> Scene::collide(const Options& options, Workspace* workspace) const {
  return guarded([&]() -> Result<Contacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    const State& s = *state_;
    std::optional<CurrentPairs> near_pairs;
    if (!is_papers_way(options)) near_pairs.emplace(s.near_pairs, options.threads);
    return run_pipeline(
        {s.view(), s.meshes, near_pairs ? &**near_pairs : nullptr, nullptr, false, options, s.own_pairs},
        *QueryMemory(workspace));
  });
}

Result<Contacts> Scene::collide_with(ObjectId id, const Options& options, Workspace* workspace) const {
  return guarded([&]() -> Result<Contacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    if (auto known = state_->check(id); !known) return known.error();
    return collide_one(*state_, state_->placed(id.index), id.index, options, workspace);
  });
}

Result<Contacts> Scene::collide_with(const Mesh& mesh, const Pose& pose, const Options& options,
                                     Workspace* workspace) const {
  return guarded([&]() -> Result<Contacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    if (auto valid = scene::validate(pose); !valid) return valid.error();
    const scene::PlacedObject placed = scene::place(mesh.state().data, pose, 0);
    return collide_one(*state_, PlacedMesh{placed, mesh.state()}, kGuest, options, workspace);
  });
}

}  // namespace impinge
