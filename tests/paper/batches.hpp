// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "paper/partition.hpp"
#include "tests/core/support.hpp"

namespace impinge::test {

/// Two placed meshes cut into leaves of up to `leaf_size` consecutive triangles, each leaf of one paired with each of
/// the other.
class LeavesOf {
 public:
  LeavesOf(const scenes::PlacedScene& scene, std::uint32_t leaf_size)
      : meshes_(meshes_of(scene)),
        mesh_a_(meshes_[scene.objects[0].mesh]),
        mesh_b_(meshes_[scene.objects[1].mesh]),
        pose_a_(scene.objects[0].pose),
        pose_b_(scene.objects[1].pose),
        leaves_a_(cut(mesh_a_, leaf_size)),
        leaves_b_(cut(mesh_b_, leaf_size)) {
    for (const auto& a : leaves_a_)
      for (const auto& b : leaves_b_) pairs_.push_back({&a, &b});
  }

  [[nodiscard]] const paper::LeafPairs& pairs() const { return pairs_; }
  [[nodiscard]] paper::PlacedMeshes placed() const {
    return {numbers_of(mesh_a_), pose_a_, numbers_of(mesh_b_), pose_b_};
  }
  [[nodiscard]] paper::Batch batch() const {
    paper::Partitioner partitioner;
    paper::Batch batch;
    for (const paper::LeafPair& pair : pairs_) partitioner.append(pair, placed(), batch);
    return batch;
  }
  [[nodiscard]] std::vector<Triangle> world_a() const { return world_triangles(mesh_a_, pose_a_); }
  [[nodiscard]] std::vector<Triangle> world_b() const { return world_triangles(mesh_b_, pose_b_); }

 private:
  static std::vector<paper::LeafBlock> cut(const Mesh& mesh, std::uint32_t leaf_size) {
    std::vector<paper::LeafBlock> leaves;
    std::vector<std::uint32_t> ids;
    const auto n = static_cast<std::uint32_t>(mesh.triangle_count());
    for (std::uint32_t t = 0; t < n; ++t) {
      ids.push_back(t);
      if (ids.size() < leaf_size && t + 1 < n) continue;
      leaves.push_back(paper::make_leaf_block(numbers_of(mesh), ids));
      ids.clear();
    }
    return leaves;
  }

  std::vector<Mesh> meshes_;
  Mesh mesh_a_, mesh_b_;
  Pose pose_a_, pose_b_;
  std::vector<paper::LeafBlock> leaves_a_, leaves_b_;
  paper::LeafPairs pairs_;
};

}  // namespace impinge::test
