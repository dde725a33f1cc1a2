// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/importer/rest_shape.hpp"

struct aiScene;

/// What assimp's glTF readers pass over in silence: extensions that change the geometry, positions that are not 32-bit
/// floats or stand elsewhere than glTF allows, morph targets, triangles cut short, and triangles whose indices are out
/// of range, which they drop.
namespace impinge::importer {

struct GltfCheck {
  std::string problem;          ///< why the file must not be read; empty if it may
  std::uint64_t triangles = 0;  ///< how many the nodes of its scene show
  SomeParts morphed;            ///< nodes whose morph targets have weights at rest
  SomeParts hidden;             ///< nodes that are not to be seen, nor what is below them (KHR_node_visibility)
};

/// Looks at the JSON of a glTF or GLB file, told by the name's ending; nothing for any other file.
std::optional<GltfCheck> check_gltf(const char* file);

/// The problem of a scene that shows fewer triangles than the file's JSON says, empty if there is none. The scene is as
/// assimp's reader made it.
std::string lost_triangles(const GltfCheck& check, const aiScene& scene);

}  // namespace impinge::importer
