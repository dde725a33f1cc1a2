// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/rest_shape.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "io/text.hpp"

namespace impinge::importer {
namespace {

using Corners = std::array<aiVector3D, 8>;

/// Of the box around a mesh.
Corners box_corners(const aiMesh& mesh) {
  aiVector3D lo, hi;
  if (mesh.mNumVertices > 0) lo = hi = mesh.mVertices[0];
  for (unsigned v = 1; v < mesh.mNumVertices; ++v)
    for (unsigned k = 0; k < 3; ++k)
      lo[k] = std::min(lo[k], mesh.mVertices[v][k]), hi[k] = std::max(hi[k], mesh.mVertices[v][k]);
  Corners corners;
  for (unsigned i = 0; i < corners.size(); ++i)
    corners[i] = {(i & 1U) != 0 ? hi.x : lo.x, (i & 2U) != 0 ? hi.y : lo.y, (i & 4U) != 0 ? hi.z : lo.z};
  return corners;
}

/// Whether they are elsewhere by more than what matrices of single precision leave.
bool are_moved(const Corners& corners, const aiMatrix4x4& from, const aiMatrix4x4& to) {
  constexpr ai_real kOfSize = 1e-4F, kOfPlace = 1e-6F;
  const ai_real size = (from * corners[7] - from * corners[0]).Length();
  return std::any_of(corners.begin(), corners.end(), [&](const aiVector3D& corner) {
    const aiVector3D was = from * corner;
    return !((to * corner - was).Length() <= kOfSize * size + kOfPlace * was.Length());
  });
}

/// Where everything of a scene is at rest.
class Rest {
 public:
  explicit Rest(const aiScene& scene) : scene_(scene) {
    std::vector<const aiNode*> stack{scene.mRootNode};
    while (!stack.empty()) {
      const aiNode* const node = stack.back();
      stack.pop_back();
      nodes_.push_back(node);
      worlds_[node] = node->mParent ? worlds_[node->mParent] * node->mTransformation : node->mTransformation;
      named_.try_emplace(node->mName.C_Str(), node);
      for (unsigned i = node->mNumChildren; i-- > 0;) stack.push_back(node->mChildren[i]);
    }
    for (unsigned i = 0; i < scene.mNumMeshes; ++i)
      if (scene.mMeshes[i]->mNumBones > 0) corners_[i] = box_corners(*scene.mMeshes[i]);
  }

  SomeParts bent_parts() const {
    SomeParts bent;
    for (const aiNode* const node : nodes_)
      if (std::any_of(node->mMeshes, node->mMeshes + node->mNumMeshes,
                      [&](unsigned mesh) { return is_bent(mesh, worlds_.at(node)); }))
        bent.add({node->mName.data, node->mName.length});
    return bent;
  }

 private:
  [[nodiscard]] bool is_bent(unsigned number, const aiMatrix4x4& drawn) const {
    const aiMesh& mesh = *scene_.mMeshes[number];
    return std::any_of(mesh.mBones, mesh.mBones + mesh.mNumBones, [&](const aiBone* bone) {
      const auto joint = named_.find(bone->mName.C_Str());
      return joint != named_.end() && bone->mNumWeights > 0 &&
             are_moved(corners_.at(number), drawn, worlds_.at(joint->second) * bone->mOffsetMatrix);
    });
  }

  const aiScene& scene_;
  std::vector<const aiNode*> nodes_;  ///< parents first
  std::map<const aiNode*, aiMatrix4x4> worlds_;
  std::map<std::string_view, const aiNode*> named_;  ///< the first of each name
  std::map<unsigned, Corners> corners_;              ///< by mesh
};

/// "1 part, 'arm', is", "2 parts (the first is 'arm') are".
std::string subject(const SomeParts& parts, std::string_view noun) {
  const bool is_one = parts.count == 1;
  std::string called = parts.first.empty() ? "" : io::in_quotes(parts.first);
  if (!called.empty()) called = is_one ? ", " + called + "," : " (the first is " + called + ")";
  return io::sentence(parts.count, " ", noun, is_one ? "" : "s", called, is_one ? " is" : " are");
}

}  // namespace

SomeParts bent_parts(const aiScene& scene) { return Rest(scene).bent_parts(); }

std::string hidden_sentence(const SomeParts& nodes) {
  return io::sentence(subject(nodes, "node"),
                      " hidden by KHR_node_visibility, which is not followed: what that hides is checked as if it were "
                      "visible.");
}

std::string reshaped_sentence(const SomeParts& parts, std::string_view by_what, std::string_view mend) {
  return io::sentence(subject(parts, "part"), " reshaped by ", by_what,
                      ", which is not read: what is checked is the shape before that. ", mend,
                      " where the file is made.");
}

}  // namespace impinge::importer
