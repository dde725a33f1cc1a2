// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Compiled once for each FclBuild (IMPINGE_BENCH_FCL_BUILD), into libraries of their own.
#include "bench/peers/fcl.hpp"

#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include "bench/peers/common.hpp"
#include "bench/peers/fcl_types.hpp"

namespace impinge::bench {

template <FclBuild Build>
struct FclMesh<Build>::State {
  std::shared_ptr<FclModel> model;
  fcl::CollisionResult<double> result;
};

template <FclBuild Build>
FclMesh<Build>::FclMesh(const scenes::MeshData& data) : state_(std::make_unique<State>()) {
  state_->model = fcl_model(data);
}

template <FclBuild Build>
FclMesh<Build>::FclMesh(FclMesh&&) noexcept = default;
template <FclBuild Build>
FclMesh<Build>::~FclMesh() = default;

template <FclBuild Build>
void FclMesh<Build>::refit(const scenes::MeshData& data) {
  constexpr bool kRefit = true, kBottomUp = true;
  state_->model->beginReplaceModel();
  state_->model->replaceSubModel(fcl_vertices(data));
  state_->model->endReplaceModel(kRefit, kBottomUp);
}

/// What `fcl::collide` comes to for two such models. Called directly, the rest of FCL need not be compiled anew.
template <FclBuild Build>
std::size_t FclMesh<Build>::collide(const Pose& pose_a, const FclMesh& b, const Pose& pose_b, std::size_t limit) {
  constexpr bool kWithContactPoints = false;
  const fcl::CollisionRequest<double> request(limit, kWithContactPoints);
  state_->result.clear();
  fcl::detail::MeshCollisionTraversalNodeOBB<double> node;
  fcl::detail::initialize(node, *state_->model, fcl_transform(pose_a), *b.state_->model, fcl_transform(pose_b), request,
                          state_->result);
  fcl::detail::collide(&node);
  return state_->result.numContacts();
}

template <FclBuild Build>
std::vector<TrianglePair> FclMesh<Build>::pairs() const {
  std::vector<TrianglePair> pairs;
  for (std::size_t i = 0; i < state_->result.numContacts(); ++i) {
    const auto& contact = state_->result.getContact(i);
    pairs.push_back({static_cast<std::uint32_t>(contact.b1), static_cast<std::uint32_t>(contact.b2)});
  }
  return sorted(std::move(pairs));
}

template class FclMesh<FclBuild::IMPINGE_BENCH_FCL_BUILD>;

}  // namespace impinge::bench
