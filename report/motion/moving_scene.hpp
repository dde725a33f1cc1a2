// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "impinge/clash.hpp"
#include "impinge/scene.hpp"
#include "report/motion/mover.hpp"

namespace impinge::report {

/// A scene of parts that move, and what is known of them from one time to the next.
class MovingScene {
 public:
  /// The scene's objects are these parts, in their order, none of them ever removed.
  MovingScene(Scene scene, std::vector<Posed> posed) : scene_(std::move(scene)), posed_(std::move(posed)) {}

  /// Tells the scene of those that are elsewhere, or in another shape, than before. Errors: as `Scene::set_pose`.
  Result<void> move_to(std::vector<Posed> posed);
  /// As `find_clashes`, which looks only at what moved since the last call.
  Result<Clashes> clashes(const ClashOptions& options) { return find_clashes(scene_, options, &memory_); }

 private:
  Scene scene_;
  std::vector<Posed> posed_;
  ClashMemory memory_;
};

}  // namespace impinge::report
