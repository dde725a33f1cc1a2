// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/fcl_peer.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBB.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <tuple>

namespace impinge::bench {
namespace {

fcl::Transform3d transform(const Pose& pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      result.linear()(row, column) = pose.R[static_cast<std::size_t>(3 * row + column)];
    result.translation()[row] = pose.t[static_cast<std::size_t>(row)];
  }
  return result;
}

bool precedes(const TrianglePair& p, const TrianglePair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); }

}  // namespace

struct FclMesh::State {
  fcl::BVHModel<fcl::OBB<double>> model;
  fcl::CollisionResult<double> result;
};

FclMesh::FclMesh(const scenes::MeshData& data) : state_(std::make_unique<State>()) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < data.xyz.size(); i += 3)
    vertices.emplace_back(data.xyz[i], data.xyz[i + 1], data.xyz[i + 2]);
  for (std::size_t i = 0; i < data.triangles.size(); i += 3)
    triangles.emplace_back(data.triangles[i], data.triangles[i + 1], data.triangles[i + 2]);
  state_->model.beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  state_->model.addSubModel(vertices, triangles);
  state_->model.endModel();
}

FclMesh::FclMesh(FclMesh&&) noexcept = default;
FclMesh::~FclMesh() = default;

std::size_t FclMesh::collide(const Pose& pose_a, const FclMesh& b, const Pose& pose_b) {
  constexpr bool kWithContactPoints = false;
  const fcl::CollisionRequest<double> request(std::numeric_limits<std::size_t>::max(), kWithContactPoints);
  state_->result.clear();
  return fcl::collide(&state_->model, transform(pose_a), &b.state_->model, transform(pose_b), request, state_->result);
}

std::vector<TrianglePair> FclMesh::pairs() const {
  std::vector<TrianglePair> pairs;
  for (std::size_t i = 0; i < state_->result.numContacts(); ++i) {
    const auto& contact = state_->result.getContact(i);
    pairs.push_back({static_cast<std::uint32_t>(contact.b1), static_cast<std::uint32_t>(contact.b2)});
  }
  std::sort(pairs.begin(), pairs.end(), precedes);
  return pairs;
}

Disagreement compare(const std::vector<TrianglePair>& exact, const std::vector<TrianglePair>& fcl) {
  std::vector<TrianglePair> missed, added;
  std::set_difference(exact.begin(), exact.end(), fcl.begin(), fcl.end(), std::back_inserter(missed), precedes);
  std::set_difference(fcl.begin(), fcl.end(), exact.begin(), exact.end(), std::back_inserter(added), precedes);
  return {missed.size(), added.size()};
}

}  // namespace impinge::bench
