// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/import_stream.hpp"

struct aiNode;
struct aiScene;

/// How the nodes of a file move.
namespace impinge::importer {

struct Movement {
  std::map<const aiNode*, std::uint32_t> numbers;  ///< of the nodes
  std::vector<io::ImportedNode> nodes;             ///< all of the scene's, parents first
  std::vector<io::Animation> animations;
  std::vector<std::string> warnings;  ///< what moves and cannot be followed
};

/// The warning about parts whose shape bones would change.
inline constexpr const char* kSkins = "it has skins, which are left out: those parts keep their shape";

/// What moves in a scene that assimp read from this file; without animations no nodes either. glTF's animations are
/// read from the file, since assimp keeps neither steps nor splines, nor any of glTF 1; those of other formats as
/// assimp gives them, keys with straight lines between.
Movement read_movement(const char* file, const aiScene& scene);

}  // namespace impinge::importer
