// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Compiled twice, once for each FclBuild (IMPINGE_BENCH_FCL_BUILD), into libraries of their own.
#include "bench/peers/fcl_distance.hpp"

#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_distance_traversal_node.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>

#include "bench/peers/fcl_types.hpp"

namespace impinge::bench {

template <FclBuild Build>
struct FclDistanceMesh<Build>::State {
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSS<double>>> model;
  fcl::DistanceResult<double> result;
};

template <FclBuild Build>
FclDistanceMesh<Build>::FclDistanceMesh(const scenes::MeshData& data) : state_(std::make_unique<State>()) {
  state_->model = fcl_model<fcl::OBBRSS<double>>(data);
}

template <FclBuild Build>
FclDistanceMesh<Build>::FclDistanceMesh(FclDistanceMesh&&) noexcept = default;
template <FclBuild Build>
FclDistanceMesh<Build>::~FclDistanceMesh() = default;

/// What `fcl::distance` comes to for two such models. Called directly, the rest of FCL need not be compiled anew.
template <FclBuild Build>
double FclDistanceMesh<Build>::distance(const Pose& pose_a, const FclDistanceMesh& b, const Pose& pose_b) {
  constexpr bool kWithNearestPoints = true;
  const fcl::DistanceRequest<double> request(kWithNearestPoints);
  state_->result.clear();
  fcl::detail::MeshDistanceTraversalNodeOBBRSS<double> node;
  fcl::detail::initialize(node, *state_->model, fcl_transform(pose_a), *b.state_->model, fcl_transform(pose_b), request,
                          state_->result);
  fcl::detail::distance(&node);
  return state_->result.min_distance;
}

template class FclDistanceMesh<FclBuild::IMPINGE_BENCH_FCL_BUILD>;

}  // namespace impinge::bench
