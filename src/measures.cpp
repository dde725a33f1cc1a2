// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/measures.hpp"

#include <limits>
#include <string>

#include "core/guarded.hpp"
#include "core/pose.hpp"
#include "domain_error.hpp"
#include "measure/nearest.hpp"
#include "mesh_state.hpp"
#include "on_threads.hpp"
#include "scene/validate_pose.hpp"

namespace impinge {
namespace {

/// What a measure is asked about.
struct Placed {
  const Mesh& mesh;
  const Pose& pose;
  const char* name;  ///< for whoever reads what is wrong with it

  [[nodiscard]] hierarchy::PlacedTree tree() const {
    const MeshState& state = mesh.state();
    return {&state.data, &state.wide_tree, pose};
  }
};

Result<void> validate(const Placed& placed) {
  const std::string name = std::string("the ") + placed.name + " mesh";
  if (auto valid = scene::validate(placed.pose); !valid)
    return Error{valid.error().code, name + ": " + valid.error().message};
  if (placed.mesh.triangle_count() == 0) return Error{Code::bad_mesh, name + " has no triangles, and no distance"};
  if (!in_exact_domain(placed.pose, placed.mesh.state().data)) return out_of_domain(name);
  return {};
}

Result<void> validate(const Placed& a, const Placed& b, const MeasureOptions& options) {
  if (options.threads < 0)
    return Error{Code::bad_option,
                 "a number of threads is 0 (all there are) or more, not " + std::to_string(options.threads)};
  for (const Placed* const placed : {&a, &b})
    if (auto valid = validate(*placed); !valid) return valid;
  return {};
}

Result<std::optional<measure::NearestPair>> nearest(const Placed& a, const Placed& b, double within, double enough,
                                                    const MeasureOptions& options) {
  if (auto valid = validate(a, b, options); !valid) return valid.error();
  auto found = measure::nearest_pair(a.tree(), b.tree(), within, enough, {on_threads(options.threads), options.stop});
  if (options.stop.stop_requested()) return Error{Code::cancelled, "the query was stopped before it was complete"};
  return found;
}

}  // namespace

Result<Nearest> distance(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                         const MeasureOptions& options) {
  return guarded([&]() -> Result<Nearest> {
    constexpr double kAnyDistance = std::numeric_limits<double>::infinity();
    const auto found = nearest({mesh_a, pose_a, "first"}, {mesh_b, pose_b, "second"}, kAnyDistance, 0, options);
    if (!found) return found.error();
    const measure::NearestPair& pair = **found;
    return Nearest{pair.distance, pair.error, pair.a, pair.b, pair.triangle_a, pair.triangle_b};
  });
}

Result<bool> closer_than(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b, double limit,
                         const MeasureOptions& options) {
  return guarded([&]() -> Result<bool> {
    if (!(limit >= 0)) return Error{Code::bad_option, "a limit of distance is a number that is not negative"};
    const auto found = nearest({mesh_a, pose_a, "first"}, {mesh_b, pose_b, "second"}, limit, limit, options);
    if (!found) return found.error();
    return *found && (*found)->distance < limit;
  });
}

}  // namespace impinge
