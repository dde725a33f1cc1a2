// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/import_stream.hpp"

struct aiNode;
struct aiScene;

/// How the nodes of a file move.
namespace impinge::importer {

/// A node whose mesh bones bend.
struct Skin {
  std::uint32_t node;
  std::vector<std::uint32_t> joints;  ///< nodes; none: it is not known which
};

struct Movement {
  std::map<const aiNode*, std::uint32_t> numbers;  ///< of the nodes
  std::vector<io::ImportedNode> nodes;             ///< all of the scene's, parents first
  std::vector<io::Animation> animations;
  std::vector<Skin> skins;
  std::vector<std::string> warnings;  ///< what moves and cannot be followed
};

/// Adds a track to an animation; one that cannot be followed, by a problem that is known already or by its keys, is
/// told of in its place. The channel is what the file calls it.
void add_track(io::Animation& animation, io::Track&& track, std::string_view channel, std::string_view problem = {});

/// The warning about parts whose shape bones would change.
inline constexpr const char* kSkins = "it has skins, which are left out: those parts keep their shape";
/// What changes the shape of a single part.
inline constexpr const char* kMorphs = "its morph targets are animated";

/// What moves in a scene that assimp read from this file; without animations no nodes either. glTF's animations are
/// read from the file, since assimp keeps neither steps nor splines, nor any of glTF 1; those of other formats as
/// assimp gives them, keys with straight lines between.
Movement read_movement(const char* file, const aiScene& scene);

/// Adds the animations of a glTF file (1 or 2) to the numbered nodes of the scene that assimp read from it. What cannot
/// be followed (morph targets, skins, pointers) is left out, with a warning. The file has passed `check_gltf`.
void read_gltf_motion(const char* file, const aiScene& scene, Movement& movement);

}  // namespace impinge::importer
