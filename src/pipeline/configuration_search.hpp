// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "broad/box_tree.hpp"
#include "impinge/scene.hpp"
#include "measure/pair_queue.hpp"
#include "pipeline/nearest_objects.hpp"
#include "pipeline/scene_state.hpp"
#include "pipeline/touch_search.hpp"

namespace impinge {

/// Objects of a scene that are tried at other poses, and which pairs of them are to be tested.
class Movers {
 public:
  /// Errors: `unknown_id`, `bad_option` (an object twice), with its place among the ids.
  static Result<Movers> of(const Scene::State& scene, std::span<const ObjectId> ids);

  [[nodiscard]] std::size_t size() const { return objects_.size(); }
  [[nodiscard]] std::uint32_t object(std::size_t i) const { return objects_[i]; }
  /// Whether the mover is to be tested against an object that stands still.
  [[nodiscard]] bool meets(std::size_t mover, std::uint32_t object) const {
    return scene_->are_tested(objects_[mover], object);
  }
  [[nodiscard]] bool moves(std::uint32_t object) const { return numbers_[object] != 0; }
  /// The number of an object that moves.
  [[nodiscard]] std::size_t mover(std::uint32_t object) const { return numbers_[object] - 1; }
  /// Pairs of movers that are tested against each other.
  [[nodiscard]] const std::vector<std::array<std::uint32_t, 2>>& pairs() const { return pairs_; }
  [[nodiscard]] const Scene::State& scene() const { return *scene_; }

 private:
  explicit Movers(const Scene::State& scene) : scene_(&scene), numbers_(scene.slots.size()) {}

  const Scene::State* scene_;
  std::vector<std::uint32_t> objects_;
  std::vector<std::uint32_t> numbers_;  ///< by object of the scene: a mover's number + 1, or 0
  std::vector<std::array<std::uint32_t, 2>> pairs_;
};

/// Movers, placed. One thread uses it at a time.
class PlacedMovers {
 public:
  explicit PlacedMovers(const Movers& movers);

  /// Errors: `bad_pose`, `out_of_range`.
  Result<void> place(std::span<const Pose> poses);
  [[nodiscard]] const scene::PlacedObject& operator[](std::size_t mover) const { return placed_[mover]; }
  [[nodiscard]] PlacedMesh mesh(std::size_t mover) const {
    return {placed_[mover], *movers_.scene().meshes[movers_.object(mover)]};
  }

 private:
  const Movers& movers_;
  std::vector<scene::PlacedObject> placed_;
  std::vector<scene::PlacedBlock> blocks_;  ///< of their meshes
};

/// Whether movers at given poses touch each other or what stands still, asked again and again by one thread. What it
/// found last time decides what it tries first, never the answer.
class TouchingConfigurations {
 public:
  using Found = std::optional<Touch>;

  /// `near_pairs` is current.
  TouchingConfigurations(const Movers& movers, const broad::NearPairs& near_pairs, const std::stop_token& stop);

  /// A pair of triangles that touch, if any do; the lower object first. Errors: `bad_pose`, `out_of_range`.
  Result<Found> find(std::span<const Pose> poses);

 private:
  /// A mover, and another one or an object of the scene.
  struct Candidate {
    std::uint32_t mover, other;
    bool other_moves;
    double square;  ///< of the distance of their spheres' centres
  };

  [[nodiscard]] PlacedMesh second(const Candidate& pair) const;
  void find_candidates();
  void add_if_near(std::uint32_t mover, std::uint32_t other, bool other_moves, const scene::PlacedObject& placed);
  [[nodiscard]] Found touch(const Candidate& pair, const TrianglePair& triangles) const;

  const Movers& movers_;
  const broad::NearPairs& near_pairs_;
  TouchSearch search_;
  std::vector<std::uint32_t> numbers_;  ///< 0, 1, .. of the movers
  std::vector<std::uint32_t> jumping_;  ///< objects that do, but movers
  PlacedMovers placed_;
  std::vector<Box> boxes_;
  broad::BoxTree::Search near_;
  std::vector<Candidate> candidates_;
  std::optional<Candidate> last_;  ///< the pair that touched last
  TrianglePair last_triangles_{};
};

/// The least distance of movers at given poses from each other and from what stands still.
class DistantConfigurations {
 public:
  using Found = std::optional<ObjectDistance>;

  DistantConfigurations(const Movers& movers, const MeasureOptions& options);
  /// Errors: `bad_pose`, `out_of_range`.
  Result<Found> find(std::span<const Pose> poses);

 private:
  const Movers& movers_;
  const MeasureOptions& options_;
  std::vector<std::array<std::uint32_t, 2>> pairs_;  ///< a mover and an object that stands still, of those to be tested
  PlacedMovers placed_;
  NearestObjectsSearch search_;
  measure::PairMemory memory_;
};

}  // namespace impinge
