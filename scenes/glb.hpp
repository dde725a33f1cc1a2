// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "scenes/scene.hpp"

namespace impinge::scenes {

/// A scene as binary glTF 2.0: each mesh once, in single precision and with its vertices as they are shared, and a node
/// with a matrix for each object, in order. A pose is kept to single precision. Names need no escaping in JSON.
std::string glb_bytes(const PlacedScene& scene, std::span<const std::string> names);

/// How a node moves: at each time its rotation, a unit quaternion x y z w, and its translation.
struct NodeMotion {
  std::vector<double> times;
  std::vector<std::array<double, 4>> rotations;
  std::vector<std::array<double, 3>> translations;
};

/// The same with one animation; each node begins where its motion does, and one with a single time stays there.
std::string glb_bytes(const PlacedScene& scene, std::span<const std::string> names,
                      std::span<const NodeMotion> motions);

}  // namespace impinge::scenes
