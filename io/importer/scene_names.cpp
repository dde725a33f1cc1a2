// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/scene_names.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "io/importer/axes.hpp"

namespace impinge::importer {
namespace {

constexpr std::string_view kPivot = "_$AssimpFbx$_";  // FBX: a step of a node's transform, as a node of its own

bool is_digits(std::string_view text) { return !text.empty() && text.find_first_not_of("0123456789") == text.npos; }

/// "nodes[12]", "meshes[3]": what assimp's glTF readers call things without a name.
bool is_gltf_placeholder(std::string_view name) {
  for (const std::string_view list : {"nodes[", "meshes["}) {
    if (name.starts_with(list) && name.ends_with(']')) {
      return is_digits(name.substr(list.size(), name.size() - list.size() - 1));
    }
  }
  return false;
}

std::string_view text_of(const aiString& text) { return {text.data, text.length}; }

}  // namespace

SceneNames::SceneNames(const aiScene& scene) : scene_(scene) {
  const std::string reader = reader_of(scene);
  is_gltf_ = reader.find("glTF") != reader.npos;
}

std::string SceneNames::given_name(const aiNode& node) const {
  const std::string_view name = text_of(node.mName);
  const bool is_root = node.mParent == nullptr;
  if (is_gltf_) {  // whatever else stands there, a person may have given
    const bool is_made_up = is_gltf_placeholder(name) || (is_root && name == "ROOT");
    return is_made_up ? std::string() : std::string(name);
  }
  if (is_root && name == "RootNode") return {};                                            // FBX and others
  if (name.starts_with('$') || (name.starts_with('<') && name.ends_with('>'))) return {};  // COLLADA, 3DS, DXF, ..
  if (name.find(kPivot) != name.npos) return {};
  return std::string(name);
}

/// Whether the node is one of the file's, with a name or without, and not one that assimp puts in between.
bool SceneNames::is_of_file(const aiNode& node) const {
  if (node.mParent == nullptr) return true;
  return is_gltf_ || text_of(node.mName).find(kPivot) == std::string_view::npos;
}

const aiNode* SceneNames::parent_of(const aiNode& node) const {
  const aiNode* at = &node;
  while (!is_of_file(*at)) at = at->mParent;
  do at = at->mParent;
  while (at && !is_of_file(*at));
  return at;
}

/// The name of the mesh that the node shows. assimp's glTF readers number the primitives of one mesh: "body-0",
/// "body-1".
std::string SceneNames::mesh_name(const aiNode& node) const {
  if (node.mNumMeshes == 0) return {};
  std::string_view name = text_of(scene_.mMeshes[node.mMeshes[0]]->mName);
  if (is_gltf_ && node.mNumMeshes > 1 && name.ends_with("-0")) name.remove_suffix(2);
  if (is_gltf_ && is_gltf_placeholder(name)) return {};
  return std::string(name);
}

NodeNames SceneNames::of(const aiNode& node) const {
  std::vector<std::string> given;  // from the node up
  for (const aiNode* at = &node; at; at = at->mParent) {
    std::string name = given_name(*at);
    if (name.empty() && at == &node) name = mesh_name(node);
    if (!name.empty()) given.push_back(std::move(name));
  }
  NodeNames names;
  if (!given.empty()) names.name = given.front();
  std::reverse(given.begin(), given.end());
  for (const std::string& name : given) names.path += (names.path.empty() ? "" : "/") + name;
  return names;
}

}  // namespace impinge::importer
