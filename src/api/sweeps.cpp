// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/sweeps.hpp"

#include <cmath>
#include <string>

#include "core/guarded.hpp"
#include "core/pose.hpp"
#include "impinge/collide.hpp"
#include "impinge/impacts.hpp"
#include "measure/safe_time.hpp"
#include "measure/triangle_distance.hpp"
#include "motion/screw.hpp"
#include "pipeline/domain_error.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/workspace_state.hpp"
#include "scene/validate_pose.hpp"

namespace impinge {
namespace {

bool turns(const Sweep& sweep) { return sweep.from.R != sweep.to.R || sweep.turns != 0; }

bool is_bent(const Sweep& sweep) { return sweep.path == Sweep::Path::screw && turns(sweep); }

Result<void> validate(const Sweep& sweep, const std::string& name) {
  for (const bool at_end : {false, true})
    if (auto valid = scene::validate(at_end ? sweep.to : sweep.from); !valid)
      return Error{valid.error().code, name + (at_end ? " at the end: " : " at the start: ") + valid.error().message};
  if (sweep.turns != 0 && sweep.path == Sweep::Path::straight)
    return Error{Code::bad_option, name + " has whole turns to make on a straight path; take a screw"};
  if (sweep.turns != 0 && !motion::Screw::has_axis(sweep.from, sweep.to))
    return Error{Code::bad_option, name +
                                       " has whole turns to make between poses that are hardly turned against each "
                                       "other, which tell no axis; give the way in two sweeps"};
  return {};
}

/// One of the two bodies.
struct Swept {
  const Mesh& mesh;
  const Sweep& sweep;
  const char* name;  ///< for errors
};

Result<void> validate(const Swept& swept) {
  const std::string name = std::string("the ") + swept.name + " mesh";
  if (auto valid = validate(swept.sweep, name); !valid) return valid;
  if (swept.mesh.triangle_count() == 0) return Error{Code::bad_mesh, name + " has no triangles, and meets nothing"};
  for (const Pose* const pose : {&swept.sweep.from, &swept.sweep.to})
    if (!in_exact_domain(*pose, swept.mesh.state().data)) return not_in_exact_domain(name);
  return {};
}

Triangle triangle_of(const Mesh& mesh, std::uint32_t i) {
  const auto& [a, b, c] = mesh.triangles()[i];
  return {mesh.vertices()[a], mesh.vertices()[b], mesh.vertices()[c]};
}

Result<std::optional<TimeOfImpact>> on_straight_paths(const Swept& a, const Swept& b, const MeasureOptions& options) {
  const auto moving = [](const Swept& swept) -> Result<Moving> {
    Result<Mesh> from = swept.mesh.transformed({swept.sweep.from.R, swept.sweep.from.t});
    if (!from) return from.error();
    Result<Mesh> to = swept.mesh.transformed({swept.sweep.to.R, swept.sweep.to.t});
    if (!to) return to.error();
    return Moving{*std::move(from), *std::move(to)};
  };
  const Result<Moving> of_a = moving(a);
  if (!of_a) return of_a.error();
  const Result<Moving> of_b = moving(b);
  if (!of_b) return of_b.error();
  // An edge through a face is no impact, so that what goes through something at the start need not have one there.
  const Result<Contacts> contacts = collide(
      of_a->from, {}, of_b->from, {}, {.find = Options::Find::first, .threads = options.threads, .stop = options.stop});
  if (!contacts) return contacts.error();
  if (!contacts->triangles.empty()) {
    const auto [i, j] = contacts->triangles[0];
    const auto [p, q] = measure::common_point(triangle_of(of_a->from, i), triangle_of(of_b->from, j));
    return std::optional(TimeOfImpact{{0, 0}, 0, p, q});
  }
  const Result<Impacts> found =
      find_impacts(*of_a, *of_b, {.earliest = true, .threads = options.threads, .stop = options.stop});
  if (!found) return found.error();
  if (found->impacts.empty()) return std::optional<TimeOfImpact>();
  const Impact& first = found->impacts.front();
  return std::optional(TimeOfImpact{first.time, 0, first.point, first.point});
}

Result<std::optional<TimeOfImpact>> on_screws(const Swept& a, const Swept& b, double tolerance,
                                              const MeasureOptions& options, Workspace* workspace) {
  const double radius_a = norm(a.mesh.state().data.max_abs), radius_b = norm(b.mesh.state().data.max_abs);
  const motion::Screw screw_a(a.sweep.from, a.sweep.to, a.sweep.turns);
  const motion::Screw screw_b(b.sweep.from, b.sweep.to, b.sweep.turns);
  const Twist twist_a = screw_a.twist(radius_a), twist_b = screw_b.twist(radius_b);
  // Both ends of a step are off.
  const double slack = 2 * (screw_a.deviation(radius_a) + screw_b.deviation(radius_b));
  measure::Approach approach{1, slack, std::max(tolerance, 4 * slack)};
  measure::LimitingPair last;
  const QueryMemory memory(workspace);
  const measure::SearchMeans means{on_threads(options.threads), options.stop, &memory->nearest};
  for (double time = 0;;) {
    const hierarchy::PlacedTree now_a = a.mesh.state().placed(screw_a.at(time)),
                                now_b = b.mesh.state().placed(screw_b.at(time));
    if (!in_exact_domain(now_a.pose, *now_a.mesh)) return not_in_exact_domain(std::string("the ") + a.name + " mesh");
    if (!in_exact_domain(now_b.pose, *now_b.mesh)) return not_in_exact_domain(std::string("the ") + b.name + " mesh");
    approach.within = 1 - time;
    const measure::SafeTime safe = measure::safe_time({now_a, twist_a}, {now_b, twist_b}, approach, last, means);
    throw_if_stopped(options.stop);
    if (safe.met) {
      // The pair that came near first need not be the nearest.
      const auto nearest =
          safe.met->distance == 0 ? safe.met : measure::nearest_pair(now_a, now_b, kInfinity, 0, means);
      throw_if_stopped(options.stop);
      return std::optional(TimeOfImpact{{time, time}, nearest->distance, nearest->a, nearest->b});
    }
    if (!safe.is_limited) return std::optional<TimeOfImpact>();
    time += safe.time;
  }
}

}  // namespace

Result<Pose> pose_at(const Sweep& sweep, double time) {
  return guarded([&]() -> Result<Pose> {
    if (auto valid = validate(sweep, "the body"); !valid) return valid.error();
    if (!(time >= 0 && time <= 1))
      return Error{Code::bad_option, "a time of a sweep is from 0 to 1, not " + std::to_string(time)};
    if (sweep.path == Sweep::Path::straight && turns(sweep))
      return Error{Code::bad_option, "a body that turns on a straight path is not rigid on the way; take a screw"};
    return motion::Screw(sweep.from, sweep.to, sweep.turns).at(time);
  });
}

Result<std::optional<TimeOfImpact>> time_of_impact(const Mesh& mesh_a, const Sweep& sweep_a, const Mesh& mesh_b,
                                                   const Sweep& sweep_b, double tolerance,
                                                   const MeasureOptions& options, Workspace* workspace) {
  return guarded([&]() -> Result<std::optional<TimeOfImpact>> {
    const Swept a{mesh_a, sweep_a, "first"}, b{mesh_b, sweep_b, "second"};
    if (options.threads < 0)
      return Error{Code::bad_option,
                   "a number of threads is 0 (all there are) or more, not " + std::to_string(options.threads)};
    if (!(tolerance > 0) || !std::isfinite(tolerance))
      return Error{Code::bad_option,
                   "a tolerance of a time of impact is a length above 0, not " + std::to_string(tolerance)};
    for (const Swept* const swept : {&a, &b})
      if (auto valid = validate(*swept); !valid) return valid.error();
    const bool is_straight = sweep_a.path == Sweep::Path::straight || sweep_b.path == Sweep::Path::straight;
    if (is_straight && (is_bent(sweep_a) || is_bent(sweep_b)))
      return Error{Code::bad_option,
                   "one mesh is on straight paths, and the other turns on a screw; take one for both"};
    return is_straight ? on_straight_paths(a, b, options) : on_screws(a, b, tolerance, options, workspace);
  });
}

}  // namespace impinge
