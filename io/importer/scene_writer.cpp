// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/scene_writer.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <array>
#include <assimp/Importer.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "io/importer/axes.hpp"
#include "io/importer/gltf_check.hpp"
#include "io/importer/motion.hpp"
#include "io/importer/rest_shape.hpp"
#include "io/importer/scene_names.hpp"
#include "io/text.hpp"

namespace impinge::importer {
namespace {

using Matrix = std::array<double, 16>;

Matrix matrix_of(const aiMatrix4x4& m) {
  return {m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4};
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix out;
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = a[4 * row] * b[column];
      for (std::size_t k = 1; k < 4; ++k) sum += a[4 * row + k] * b[4 * k + column];
      out[4 * row + column] = sum;
    }
  }
  return out;
}

/// How many triangles the polygons of a scene make.
std::uint64_t triangles_in(const aiScene& scene) {
  std::uint64_t count = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      if (mesh.mFaces[f].mNumIndices >= 3) count += mesh.mFaces[f].mNumIndices - 2;
    }
  }
  return count;
}

/// Writes the meshes of nodes, each list of meshes once.
class MeshWriter {
 public:
  MeshWriter(const aiScene& scene, io::ImportWriter& writer) : scene_(scene), writer_(writer) {}

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// The number of the node's mesh, kNone without triangles.
  std::uint32_t write(const aiNode& node) {
    if (node.mNumMeshes == 0) return kNone;
    const auto [place, is_new] = known_.try_emplace({node.mMeshes, node.mMeshes + node.mNumMeshes}, kNone);
    if (is_new) {
      xyz_.clear();
      triangles_.clear();
      for (const unsigned index : place->first) append(*scene_.mMeshes[index]);
      if (!triangles_.empty()) {
        writer_.mesh(xyz_, triangles_);
        place->second = count_++;
      }
    }
    return place->second;
  }

 private:
  void append(const aiMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(xyz_.size() / 3);
    bool has_triangles = false;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      has_triangles = true;
      for (unsigned k = 0; k < 3; ++k) triangles_.push_back(first + face.mIndices[k]);
    }
    for (unsigned v = 0; has_triangles && v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      xyz_.insert(xyz_.end(), {double{p.x}, double{p.y}, double{p.z}});
    }
  }

  const aiScene& scene_;
  io::ImportWriter& writer_;
  std::map<std::vector<unsigned>, std::uint32_t> known_;
  std::uint32_t count_ = 0;
  std::vector<double> xyz_;
  std::vector<std::uint32_t> triangles_;
};

/// Writes the nodes that objects hang under, each once and its parents first.
class GroupWriter {
 public:
  GroupWriter(const SceneNames& names, io::ImportWriter& writer) : names_(names), writer_(writer) {}

  /// The number of the group that the node hangs under.
  std::uint32_t write_above(const aiNode& node) {
    std::vector<const aiNode*> fresh;  // from the node up
    std::uint32_t group = io::kNoNode;
    for (const aiNode* at = names_.parent_of(node); at; at = names_.parent_of(*at)) {
      if (const auto known = numbers_.find(at); known != numbers_.end()) {
        group = known->second;
        break;
      }
      fresh.push_back(at);
    }
    for (; !fresh.empty(); fresh.pop_back()) {
      writer_.group(names_.given_name(*fresh.back()), group);
      group = static_cast<std::uint32_t>(numbers_.size());
      numbers_.emplace(fresh.back(), group);
    }
    return group;
  }

 private:
  const SceneNames& names_;
  io::ImportWriter& writer_;
  std::map<const aiNode*, std::uint32_t> numbers_;
};

void write_objects(const aiScene& scene, const Movement& movement, io::ImportWriter& writer) {
  struct Visit {
    const aiNode* node;
    Matrix parent;
  };
  const SceneNames names(scene);
  MeshWriter meshes(scene, writer);
  GroupWriter groups(names, writer);
  constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::vector<Visit> stack{{scene.mRootNode, kIdentity}};
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    const aiNode& node = *visit.node;
    const bool is_root = node.mParent == nullptr;
    const Matrix local = matrix_of(node.mTransformation);
    const Matrix world = is_root ? local : product(visit.parent, local);
    if (const std::uint32_t mesh = meshes.write(node); mesh != MeshWriter::kNone) {
      const NodeNames called = names.of(node);
      const auto number = movement.numbers.find(&node);
      const std::uint32_t numbered = number == movement.numbers.end() ? io::kNoNode : number->second;
      const std::uint32_t group = groups.write_above(node);
      writer.object(called.name, called.path, {}, mesh, numbered, group, world);
    }
    for (unsigned i = node.mNumChildren; i-- > 0;) stack.push_back({node.mChildren[i], world});
  }
}

}  // namespace

std::string write_scene(const char* file, io::ImportWriter& writer) {
  const std::optional<GltfCheck> gltf = check_gltf(file);
  if (gltf && !gltf->problem.empty()) return gltf->problem;
  Assimp::Importer importer;
  // These are read elsewhere, whatever a file of theirs is called.
  std::array<std::unique_ptr<Assimp::BaseImporter>, 2> others;
  for (std::size_t i = 0; i < others.size(); ++i) {
    others[i].reset(importer.GetImporter(importer.GetImporterIndex(i == 0 ? "ifc" : "3mf")));
    importer.UnregisterLoader(others[i].get());
  }
  // The author's names, not the ids of COLLADA.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  // Bones are not surfaces.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  // Validation comes first: some files give scenes without a root, or with indices out of range. But what is wrong with
  // an animation of glTF keeps nobody from reading the rest; they are read from the file itself.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_ANIMATIONS);
  const aiScene* scene = importer.ReadFile(file, gltf ? aiProcess_RemoveComponent : aiProcess_ValidateDataStructure);
  if (gltf && scene) scene = importer.ApplyPostProcessing(aiProcess_ValidateDataStructure);
  if (!scene || !scene->mRootNode) {
    const std::string problem = importer.GetErrorString();
    return problem.empty() ? "it gives no reason" : problem;
  }
  if (gltf) {
    if (std::string problem = lost_triangles(*gltf, *scene); !problem.empty()) return problem;
  }
  const std::uint64_t expected = triangles_in(*scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (!scene || !scene->mRootNode) return "it cannot cut the polygons into triangles";
  if (const std::uint64_t found = triangles_in(*scene); found < expected) {
    writer.missing(io::sentence("assimp could not cut every polygon: ", expected - found, " of ", expected,
                                " triangles are missing; export the file with triangulated faces."));
  }
  if (const SomeParts bent = bent_parts(*scene); bent.count > 0)
    writer.missing(reshaped_sentence(bent, "bones", "Apply the skin"));
  if (gltf && gltf->morphed.count > 0) writer.missing(reshaped_sentence(gltf->morphed, "morph targets", "Apply them"));
  if (gltf && gltf->hidden.count > 0) writer.warning(hidden_sentence(gltf->hidden));
  for (const std::string& warning : axis_warnings(*scene)) writer.warning(warning);
  if (const std::optional<double> metres = unit_in_metres(*scene)) writer.unit(*metres);
  const Movement movement = read_movement(file, *scene);
  for (const io::ImportedNode& node : movement.nodes) writer.node(node);
  for (const io::Animation& animation : movement.animations) writer.animation(animation);
  for (const std::string& warning : movement.warnings) writer.warning(warning);
  write_objects(*scene, movement, writer);
  return {};
}

}  // namespace impinge::importer
