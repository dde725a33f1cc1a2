// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBB.h>
#include <fcl/math/bv/utility.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>

#include <memory>
#include <vector>

#include "impinge/mesh.hpp"
#include "scenes/scene.hpp"

namespace impinge::bench {

using FclModel = fcl::BVHModel<fcl::OBB<double>>;

inline fcl::Transform3d fcl_transform(const Pose& pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      result.linear()(row, column) = pose.R[static_cast<std::size_t>(3 * row + column)];
    result.translation()[row] = pose.t[static_cast<std::size_t>(row)];
  }
  return result;
}

inline std::vector<fcl::Vector3d> fcl_vertices(const scenes::MeshData& data) {
  std::vector<fcl::Vector3d> vertices;
  vertices.reserve(data.vertex_count());
  for (std::size_t i = 0; i < data.xyz.size(); i += 3)
    vertices.emplace_back(data.xyz[i], data.xyz[i + 1], data.xyz[i + 2]);
  return vertices;
}

/// With its whole tree built.
template <class Volume = fcl::OBB<double>>
std::shared_ptr<fcl::BVHModel<Volume>> fcl_model(const scenes::MeshData& data) {
  const std::vector<fcl::Vector3d> vertices = fcl_vertices(data);
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(data.triangle_count());
  for (std::size_t i = 0; i < data.triangles.size(); i += 3)
    triangles.emplace_back(data.triangles[i], data.triangles[i + 1], data.triangles[i + 2]);
  auto model = std::make_shared<fcl::BVHModel<Volume>>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

}  // namespace impinge::bench
