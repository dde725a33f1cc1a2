// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "scenes/scene.hpp"

namespace impinge::bench {

/// Many bodies in FCL's terms: `DynamicAABBTreeCollisionManager` over meshes with trees of oriented boxes.
class FclCrowd {
 public:
  explicit FclCrowd(const scenes::PlacedScene& scene);
  ~FclCrowd();

  /// A pose a body, and the boxes around them that the manager goes by.
  void move(std::span<const Pose> poses);
  /// The broad phase alone: repairs the manager's tree and counts the pairs of bodies whose boxes meet.
  std::size_t broad_phase();
  /// The same, and every pair of triangles; returns the number of those. With a point, a normal and a depth for each
  /// pair if wanted.
  std::size_t collide(bool with_points = false);
  /// (body, body, triangle, triangle) of the last `collide`, lower body first, sorted.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 4>> contacts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The broad phases of FCL that a planner may choose among.
enum class FclManager : std::uint8_t { tree, tree_array, sweep_and_prune };

/// A robot among obstacles, as planners use FCL: the manager holds the obstacles, which stand still, and is asked about
/// one link after the other, with a callback that ends at the first contact or keeps the least distance.
class FclRobot {
 public:
  /// `pairs` are the links that are tested against each other.
  FclRobot(FclManager manager, const scenes::PlacedScene& obstacles, const scenes::PlacedScene& links,
           std::vector<std::array<std::uint32_t, 2>> pairs);
  ~FclRobot();

  /// A pose a link, and the boxes around them that the manager goes by.
  void place(std::span<const Pose> poses);
  /// Moves one obstacle, of which the manager is told.
  void move_obstacle(std::size_t i, const Pose& pose);
  /// Whether links at these poses touch an obstacle or each other; meshes have trees of oriented boxes.
  bool touches(std::span<const Pose> poses);
  /// How far they are from the nearest of those; meshes have the trees that FCL's manual recommends for distances.
  double distance(std::span<const Pose> poses);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace impinge::bench
