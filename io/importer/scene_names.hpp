// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

struct aiNode;
struct aiScene;

/// What the objects of an assimp scene are called.
namespace impinge::importer {

struct NodeNames {
  std::string name;  ///< the nearest given name: the node's, its mesh's, an ancestor's; empty if there is none
  std::string path;  ///< the given names from the root to the node, '/' between them
};

/// Names the nodes of one scene.
class SceneNames {
 public:
  explicit SceneNames(const aiScene& scene);
  [[nodiscard]] NodeNames of(const aiNode& node) const;
  /// The name that the file's author gave, or an empty one: assimp makes up names of its own.
  [[nodiscard]] std::string given_name(const aiNode& node) const;
  /// The node of the file that it hangs under; none for the root.
  [[nodiscard]] const aiNode* parent_of(const aiNode& node) const;

 private:
  [[nodiscard]] bool is_of_file(const aiNode& node) const;
  [[nodiscard]] std::string mesh_name(const aiNode& node) const;

  const aiScene& scene_;
  bool is_gltf_ = false;
};

}  // namespace impinge::importer
