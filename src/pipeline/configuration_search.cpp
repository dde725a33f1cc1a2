// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/configuration_search.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "broad/may_touch.hpp"
#include "pipeline/domain_error.hpp"
#include "scene/validate_pose.hpp"

namespace impinge {

Result<Movers> Movers::of(const Scene::State& scene, std::span<const ObjectId> ids) {
  Movers movers(scene);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::string place = "ids[" + std::to_string(i) + "]: ";
    if (auto known = scene.check(ids[i]); !known) return Error{known.error().code, place + known.error().message};
    if (std::exchange(movers.numbers_[ids[i].index], static_cast<std::uint32_t>(i + 1)) != 0)
      return Error{Code::bad_option, place + "this object was named before; name each once"};
    movers.objects_.push_back(ids[i].index);
  }
  for (std::uint32_t i = 0; i < ids.size(); ++i)
    for (std::uint32_t k = i + 1; k < ids.size(); ++k)
      if (scene.are_tested(ids[i].index, ids[k].index)) movers.pairs_.push_back({i, k});
  return movers;
}

PlacedMovers::PlacedMovers(const Movers& movers)
    : movers_(movers),
      placed_(movers.size()),
      blocks_((movers.size() + scene::PlacedBlock::kMost - 1) / scene::PlacedBlock::kMost) {
  static constexpr Pose kAnywhere;
  for (std::size_t i = 0; i < movers.size(); ++i)
    blocks_[i / scene::PlacedBlock::kMost].add(movers.scene().meshes[movers.object(i)]->data, kAnywhere);
}

Result<void> PlacedMovers::place(std::span<const Pose> poses) {
  std::size_t first = 0;
  for (scene::PlacedBlock& block : blocks_) {
    for (std::size_t i = 0; i < block.size(); ++i) block.set_pose(i, poses[first + i]);
    block.compute();
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (!block.is_valid(i))
        if (auto valid = scene::validate(poses[first + i]); !valid) return valid;
      block.write(i, placed_[first + i]);
      if (!placed_[first + i].in_domain) return not_in_range("object " + std::to_string(movers_.object(first + i)));
    }
    first += block.size();
  }
  return {};
}

TouchingConfigurations::TouchingConfigurations(const Movers& movers, const broad::NearPairs& near_pairs,
                                               const std::stop_token& stop)
    : movers_(movers),
      near_pairs_(near_pairs),
      search_(stop),
      numbers_(movers.size()),
      placed_(movers),
      boxes_(movers.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0);
  for (const std::uint32_t object : near_pairs.jumping())
    if (!movers.moves(object)) jumping_.push_back(object);
}

PlacedMesh TouchingConfigurations::second(const Candidate& pair) const {
  return pair.other_moves ? placed_.mesh(pair.other) : movers_.scene().placed(pair.other);
}

TouchingConfigurations::Found TouchingConfigurations::touch(const Candidate& pair,
                                                            const TrianglePair& triangles) const {
  const std::uint32_t mover = movers_.object(pair.mover),
                      other = pair.other_moves ? movers_.object(pair.other) : pair.other;
  if (mover < other) return Touch{{mover, other}, triangles};
  return Touch{{other, mover}, {triangles.b, triangles.a}};
}

void TouchingConfigurations::add_if_near(std::uint32_t mover, std::uint32_t other, bool other_moves,
                                         const scene::PlacedObject& placed) {
  if (!broad::bounds_meet(placed_[mover], placed)) return;
  const Vec3 d = placed_[mover].sphere.center - placed.sphere.center;
  candidates_.push_back({mover, other, other_moves, dot(d, d)});
}

void TouchingConfigurations::find_candidates() {
  candidates_.clear();
  for (const auto& [i, k] : movers_.pairs()) add_if_near(i, k, true, placed_[k]);
  const auto add = [&](std::uint32_t mover, std::uint32_t object) {
    if (!movers_.moves(object) && movers_.meets(mover, object))
      add_if_near(mover, object, false, movers_.scene().objects[object]);
  };
  near_pairs_.find_resting(numbers_, boxes_, near_);
  for (const std::uint64_t found : near_.found)
    add(static_cast<std::uint32_t>(found >> 32), static_cast<std::uint32_t>(found));
  for (const std::uint32_t object : jumping_)
    for (const std::uint32_t mover : numbers_) add(mover, object);
  // The nearest first: they are the likeliest to touch.
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& c, const Candidate& d) { return c.square < d.square; });
}

Result<TouchingConfigurations::Found> TouchingConfigurations::find(std::span<const Pose> poses) {
  if (auto placed = placed_.place(poses); !placed) return placed.error();
  for (std::size_t i = 0; i < poses.size(); ++i) boxes_[i] = placed_[i].box;
  if (last_ && broad::bounds_meet(placed_[last_->mover], second(*last_).object) &&
      search_.is_contact(placed_.mesh(last_->mover), second(*last_), last_triangles_))
    return touch(*last_, last_triangles_);
  find_candidates();
  for (const Candidate& candidate : candidates_) {
    if (search_.is_stopped()) break;
    if (const auto triangles = search_.find(placed_.mesh(candidate.mover), second(candidate))) {
      last_ = candidate, last_triangles_ = *triangles;
      return touch(candidate, *triangles);
    }
  }
  return Found();
}

DistantConfigurations::DistantConfigurations(const Movers& movers, const MeasureOptions& options)
    : movers_(movers), options_(options), placed_(movers), search_(1, options.stop_above, options.enough_below) {
  const Scene::State& scene = movers.scene();
  for (std::uint32_t mover = 0; mover < movers.size(); ++mover)
    for (std::uint32_t object = 0; object < scene.objects.size(); ++object)
      if (scene.objects[object].mesh != nullptr && !movers.moves(object) && movers.meets(mover, object))
        pairs_.push_back({mover, object});
}

Result<DistantConfigurations::Found> DistantConfigurations::find(std::span<const Pose> poses) {
  if (auto placed = placed_.place(poses); !placed) return placed.error();
  const Scene::State& scene = movers_.scene();
  for (const auto& [mover, object] : pairs_)
    search_.offer(movers_.object(mover), placed_[mover], object, scene.objects[object]);
  for (const auto& [i, k] : movers_.pairs())
    search_.offer(movers_.object(i), placed_[i], movers_.object(k), placed_[k]);
  const auto placed = [&](std::uint32_t object) {
    return movers_.moves(object) ? placed_.mesh(movers_.mover(object)) : scene.placed(object);
  };
  const std::span<const NearestObjects> nearest = search_.find(placed, {{}, options_.stop, &memory_});
  return nearest.empty() ? Found() : Found(object_distance(nearest.front()));
}

}  // namespace impinge
