// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// impinge_model_oracle MODEL SET: loads a model by assimp in this process, places its nodes by its own code and writes
/// every pair of triangles of different nodes that touch.
///
/// Objects are the nodes that have triangles, depth first, a node before its children: the triangles of all its meshes,
/// one mesh after the other. Its matrix is the product of the node matrices from the root down, in double, each entry's
/// four products added from left to right.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <iostream>

#include "decide.hpp"

namespace {

using Matrix = std::array<std::array<double, 4>, 4>;

Matrix matrix_of(const aiMatrix4x4& m) {
  return {{{m.a1, m.a2, m.a3, m.a4}, {m.b1, m.b2, m.b3, m.b4}, {m.c1, m.c2, m.c3, m.c4}, {m.d1, m.d2, m.d3, m.d4}}};
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      c[i][j] = ((a[i][0] * b[0][j] + a[i][1] * b[1][j]) + a[i][2] * b[2][j]) + a[i][3] * b[3][j];
  return c;
}

oracle::Mesh mesh_of(const aiScene& scene, const aiNode& node) {
  oracle::Mesh result;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    const auto offset = static_cast<std::uint32_t>(result.vertices.size());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v)
      result.vertices.push_back({mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z});
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices == 3)  // the others are points and lines
        result.triangles.push_back({offset + face.mIndices[0], offset + face.mIndices[1], offset + face.mIndices[2]});
    }
  }
  return result;
}

void add_objects(const aiScene& scene, const aiNode& node, const Matrix& above, std::vector<oracle::WorldObject>& to) {
  const Matrix m = product(above, matrix_of(node.mTransformation));
  const oracle::Mesh mesh = mesh_of(scene, node);
  if (!mesh.triangles.empty())
    to.push_back(
        oracle::placed(mesh, {{m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1], m[2][2]},
                              {m[0][3], m[1][3], m[2][3]}}));
  for (unsigned i = 0; i < node.mNumChildren; ++i) add_objects(scene, *node.mChildren[i], m, to);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: impinge_model_oracle MODEL SET\n";
    return 2;
  }
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile(argv[1], aiProcess_Triangulate | aiProcess_ValidateDataStructure);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::cerr << argv[1] << ": " << importer.GetErrorString() << "\n";
    return 2;
  }
  constexpr Matrix kIdentity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  std::vector<oracle::WorldObject> objects;
  add_objects(*scene, *scene->mRootNode, kIdentity, objects);
  oracle::Counts counts;
  const auto contacts = oracle::contacts_of(objects, counts);
  if (!oracle::write_contacts(argv[2], contacts)) {
    std::cerr << argv[2] << ": cannot be written.\n";
    return 2;
  }
  std::cout << objects.size() << " objects, " << contacts.size() << " contacts, " << counts.candidates
            << " candidates, " << counts.rationals << " decided by rationals\n";
  return 0;
}
