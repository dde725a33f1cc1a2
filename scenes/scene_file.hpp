// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "scenes/scene.hpp"

namespace impinge::scenes {

/// A scene as the oracle reads it, in the machine's byte order (tests/oracle/README.md):
/// "impscn01"; u64 meshes, u64 objects; a mesh: u64 vertices, u64 triangles, doubles, u32 indices; an object:
/// u32 mesh, u32 group, 9 doubles R, 3 doubles t.
std::string scene_bytes(const PlacedScene& scene);

}  // namespace impinge::scenes
