// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/measures.hpp"

#include <string>

#include "core/guarded.hpp"
#include "core/pose.hpp"
#include "measure/nearest.hpp"
#include "pipeline/domain_error.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/nearest_objects.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/workspace_state.hpp"
#include "scene/validate_pose.hpp"

namespace impinge {
namespace {

/// One of the two placed meshes of a measure.
struct Measured {
  const Mesh& mesh;
  const Pose& pose;
  const char* name;  ///< "first" or "second", for errors

  [[nodiscard]] std::string title() const { return std::string("the ") + name + " mesh"; }
};

Result<void> validate(const Measured& placed) {
  if (auto valid = scene::validate(placed.pose); !valid)
    return Error{valid.error().code, placed.title() + ": " + valid.error().message};
  if (placed.mesh.triangle_count() == 0)
    return Error{Code::bad_mesh, placed.title() + " has no triangles, and no distance"};
  const MeshData& numbers = placed.mesh.state().data;
  if (!in_exact_domain(placed.pose, numbers) && !in_range(placed.pose, numbers)) return not_in_range(placed.title());
  return {};
}

Result<void> validate(const Measured& a, const Measured& b, const MeasureOptions& options) {
  if (options.threads < 0)
    return Error{Code::bad_option,
                 "a number of threads is 0 (all there are) or more, not " + std::to_string(options.threads)};
  if (auto valid = validate_limits(options); !valid) return valid;
  for (const Measured* const placed : {&a, &b})
    if (auto valid = validate(*placed); !valid) return valid;
  return {};
}

/// Distances above `within` are of no interest, and any distance below `enough` will do.
struct Reach {
  double within, enough;
};

Result<std::optional<measure::NearestPair>> nearest(const Measured& a, const Measured& b, const Reach& reach,
                                                    const MeasureOptions& options, Workspace* workspace) {
  if (auto valid = validate(a, b, options); !valid) return valid.error();
  QueryMemory memory(workspace);
  auto found = measure::nearest_pair(a.mesh.state().placed(a.pose), b.mesh.state().placed(b.pose), reach.within,
                                     reach.enough, {on_threads(options.threads), options.stop, &memory.nearest()});
  if (options.stop.stop_requested()) return cancelled();
  return found;
}

}  // namespace

Result<Nearest> distance(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                         const MeasureOptions& options, Workspace* workspace) {
  return guarded([&]() -> Result<Nearest> {
    const auto found = nearest({mesh_a, pose_a, "first"}, {mesh_b, pose_b, "second"},
                               {options.stop_above, options.enough_below}, options, workspace);
    if (!found) return found.error();
    if (!*found) return Nearest{.distance = kInfinity};
    const measure::NearestPair& pair = **found;
    return Nearest{pair.distance, pair.error, pair.a, pair.b, pair.triangle_a, pair.triangle_b};
  });
}

Result<bool> closer_than(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b, double limit,
                         const MeasureOptions& options, Workspace* workspace) {
  return guarded([&]() -> Result<bool> {
    if (!(limit >= 0)) return Error{Code::bad_option, "a limit of distance is a number that is not negative"};
    const auto found =
        nearest({mesh_a, pose_a, "first"}, {mesh_b, pose_b, "second"}, {limit, limit}, options, workspace);
    if (!found) return found.error();
    return *found && (*found)->distance < limit;
  });
}

}  // namespace impinge
