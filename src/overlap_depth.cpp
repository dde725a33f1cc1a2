// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <string>

#include "clash/depth.hpp"
#include "core/guarded.hpp"
#include "core/pose.hpp"
#include "impinge/measures.hpp"
#include "mesh_state.hpp"
#include "pipeline.hpp"
#include "scene/validate_pose.hpp"
#include "solid/topology.hpp"

namespace impinge {
namespace {

Result<solid::Body> closed_body(const Mesh& mesh, const Pose& pose, const std::string& name) {
  if (auto valid = scene::validate(pose); !valid) return valid.error();
  const MeshState& state = mesh.state();
  if (!in_exact_domain(pose, state.data))
    return Error{Code::out_of_range,
                 name + " has a world coordinate that is not below 2^300 or not a multiple of 2^-358; rescale it"};
  solid::Body body = solid::make_body({&state.data, &state.wide_tree, pose});
  if (!solid::examine(body).closed)
    return Error{Code::bad_mesh, name +
                                     " is not closed, so that nothing is inside of it; close it, or ask for the "
                                     "distance instead"};
  return body;
}

}  // namespace

Result<OverlapDepth> overlap_depth(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                                   double precision, const MeasureOptions& options) {
  return guarded([&]() -> Result<OverlapDepth> {
    if (auto valid = validate(Options{.threads = options.threads}); !valid) return valid.error();
    if (!(precision > 0 && precision <= 1))
      return Error{Code::bad_option, "precision is " + std::to_string(precision) + "; choose one above 0, up to 1"};
    const auto a = closed_body(mesh_a, pose_a, "the first mesh");
    if (!a) return a.error();
    const auto b = closed_body(mesh_b, pose_b, "the second mesh");
    if (!b) return b.error();
    const clash::DepthGoal goal{.precision = precision, .stop = options.stop};
    const OverlapDepth depth{clash::depth_in(*a, *b, goal), clash::depth_in(*b, *a, goal)};
    if (options.stop.stop_requested()) return Error{Code::cancelled, "the query was stopped before it was complete"};
    return depth;
  });
}

}  // namespace impinge
