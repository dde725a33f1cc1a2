// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <deque>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/guarded.hpp"
#include "core/hash.hpp"
#include "core/pose.hpp"
#include "impinge/impacts.hpp"
#include "motion/box_path.hpp"
#include "pipeline/impacts_of_pairs.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/scene_state.hpp"
#include "scene/scene_view.hpp"

namespace impinge {
namespace {

/// What a scene's objects do between the last step and now.
class SceneMotion {
 public:
  SceneMotion(const Scene::State& scene, const MotionOptions& options) : scene_(scene), options_(options) {}

  Result<SceneImpacts> find() {
    if (auto valid = place_starts(); !valid) return valid.error();
    const broad::ObjectPairs pairs = find_pairs();
    std::vector<MovingObject> objects(scene_.objects.size());
    for (const auto& [a, b] : pairs)
      for (const std::uint32_t i : {a, b})
        if (objects[i].features == nullptr) objects[i] = object(i);
    SceneImpacts impacts = impacts_of_pairs(objects, pairs, options_);
    impacts.hash = hash(impacts);
    return impacts;
  }

 private:
  /// An object at the start: where it is now, unless it has come from somewhere else with the same triangles.
  struct Start {
    const MeshState* mesh;
    scene::PlacedObject placed;
    bool moves = false;
  };

  Result<void> place_starts() {
    for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
      const scene::PlacedObject& now = scene_.objects[i];
      starts_.push_back({scene_.meshes[i], now});
      if (now.mesh == nullptr) continue;
      const auto& [mesh, pose] = *scene_.slots[i].start;
      const MeshState& before = mesh.state();
      const bool is_same_mesh = &before == scene_.meshes[i];
      if (is_same_mesh && pose.R == now.pose.R && pose.t == now.pose.t) continue;
      const bool are_shared = before.data.shared_triangles == now.mesh->shared_triangles;
      if (!are_shared && !std::ranges::equal(before.data.triangles, now.mesh->triangles)) continue;
      starts_.back() = {&before, scene::place(before.data, pose, now.group), true};
      if (!starts_.back().placed.in_domain)
        return not_in_range("object " + std::to_string(i) + ", at the start of its motion,");
    }
    return {};
  }

  [[nodiscard]] motion::BoxPath bounds(std::uint32_t i) const {
    return motion::grown({starts_[i].placed.box, scene_.objects[i].box}, options_.separation);
  }

  /// Those whose boxes over the whole motion overlap, and whose boxes at both ends do not say that they never meet.
  [[nodiscard]] broad::ObjectPairs find_pairs() const {
    std::vector<Box> boxes(starts_.size(), kEmpty);
    for (std::uint32_t i = 0; i < starts_.size(); ++i) {
      if (starts_[i].placed.mesh == nullptr) continue;
      const auto [from, to] = bounds(i);
      boxes[i] = {min(from.lo, to.lo), max(from.hi, to.hi)};
    }
    broad::ObjectPairs pairs = scene_.own_pairs;
    for (const std::uint64_t key : scene_.overlapping(boxes)) {
      const auto a = static_cast<std::uint32_t>(key >> 32), b = static_cast<std::uint32_t>(key);
      if (!motion::stay_apart(bounds(a), bounds(b), options_.end)) pairs.push_back({a, b});
    }
    std::ranges::sort(pairs, {}, [](const broad::ObjectPair& pair) { return std::pair(pair.a, pair.b); });
    return pairs;
  }

  /// A mesh's world vertices. What no triangle uses may be beyond all range, and is put where nothing else is.
  std::span<const Vec3> world_vertices(const MeshState& mesh, const Pose& pose) {
    std::vector<Vec3>& world = world_.emplace_back(mesh.data.vertices);
    pose_all_vertices(pose, world);
    for (std::size_t i = 0; i < world.size(); ++i)
      if (!in_range(world[i])) world[i] = {0x1p301, static_cast<double>(i), 0};
    return world;
  }

  MovingObject object(std::uint32_t i) {
    if (scene_.objects[i].mesh == nullptr) return {};
    const MeshState& mesh = *scene_.meshes[i];
    const auto to = world_vertices(mesh, scene_.objects[i].pose);
    const auto from = starts_[i].moves ? world_vertices(*starts_[i].mesh, starts_[i].placed.pose) : to;
    return {{from, to}, &mesh.features->of(mesh.data.triangles), mesh.features.get()};
  }

  /// docs/hash.md
  [[nodiscard]] std::uint64_t hash(const SceneImpacts& impacts) const {
    const auto key = [&](std::uint32_t i) {
      return mix(scene::key(starts_[i].mesh->data, starts_[i].placed.pose),
                 scene::key(scene_.meshes[i]->data, scene_.objects[i].pose));
    };
    std::uint64_t sum = 0;
    for (std::size_t row = 0; row < impacts.objects.size(); ++row) {
      const std::uint64_t key_a = key(impacts.objects[row][0]), key_b = key(impacts.objects[row][1]);
      for (std::uint64_t i = impacts.offsets[row]; i < impacts.offsets[row + 1]; ++i) {
        const Impact& x = impacts.impacts[i];
        enum : std::uint64_t { vertex, face, edge };
        constexpr std::uint64_t kWords[][2] = {{vertex, face}, {face, vertex}, {edge, edge}};  // by Feature
        const auto [of_a, of_b] = kWords[static_cast<std::size_t>(x.feature)];
        const auto [lo, hi] = std::minmax({mix(mix(key_a, of_a), x.a), mix(mix(key_b, of_b), x.b)});
        sum += mix(mix(mix(lo, hi), number_bits(x.time.lo)), number_bits(x.time.hi));
      }
    }
    return sum;
  }

  const Scene::State& scene_;
  const MotionOptions& options_;
  std::vector<Start> starts_;
  std::deque<std::vector<Vec3>> world_;
};

}  // namespace

Result<SceneImpacts> Scene::find_impacts() const { return find_impacts(MotionOptions{}); }

Result<SceneImpacts> Scene::find_impacts(const MotionOptions& options) const {
  return guarded([&]() -> Result<SceneImpacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    if (auto valid = state_->check_domain(); !valid) return valid.error();
    return SceneMotion(*state_, options).find();
  });
}

}  // namespace impinge
