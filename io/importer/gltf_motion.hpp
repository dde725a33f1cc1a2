// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "io/importer/motion.hpp"

namespace impinge::importer {

/// Adds the animations of a glTF file (1 or 2) to the numbered nodes of the scene that assimp read from it. What cannot
/// be followed (morph targets, skins, pointers) is left out, with a warning. The file has passed `check_gltf`.
void read_gltf_motion(const char* file, const aiScene& scene, Movement& movement);

}  // namespace impinge::importer
