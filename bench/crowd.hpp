// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "impinge/mesh.hpp"
#include "scenes/scene.hpp"

/// Many bodies that move slowly.
namespace impinge::bench {

/// Torus knots of 968 triangles, turned at random, on a lattice that is shaken a little: most of them touch a
/// neighbour, none deeply. Each body swings about its own place, by no more than a hundredth of its size and a degree a
/// frame, so that after the last frame comes the first.
class Crowd {
 public:
  explicit Crowd(int bodies);

  static constexpr std::size_t kFrames = 32;
  [[nodiscard]] const scenes::PlacedScene& scene() const { return scene_; }
  /// A pose a body.
  [[nodiscard]] const std::vector<Pose>& frame(std::size_t i) const { return frames_[i % kFrames]; }

 private:
  scenes::PlacedScene scene_;
  std::vector<std::vector<Pose>> frames_;
};

}  // namespace impinge::bench
