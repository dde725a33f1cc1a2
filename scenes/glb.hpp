// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "scenes/scene.hpp"

namespace impinge::scenes {

/// A scene as binary glTF 2.0: each mesh once, in single precision and with its vertices as they are shared, and a node
/// with a matrix for each object, in order. A pose is kept to single precision. Names need no escaping in JSON.
std::string glb_bytes(const PlacedScene& scene, std::span<const std::string> names);

}  // namespace impinge::scenes
