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

}  // namespace impinge::bench
