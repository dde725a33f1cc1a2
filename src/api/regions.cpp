// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/regions.hpp"

#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "clash/regions/regions.hpp"
#include "core/guarded.hpp"
#include "core/local_frame.hpp"
#include "core/pose.hpp"
#include "impinge/collide.hpp"
#include "pipeline/domain_error.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/pair_judge.hpp"
#include "solid/part.hpp"

namespace impinge {
namespace {

/// The tolerance that is applied: 0 if the option's is below what rounding leaves of the coordinates.
Result<double> tolerance_for(const solid::Body& a, const solid::Body& b, const RegionOptions& options) {
  const double tolerance = options.tolerance;
  if (!(tolerance >= 0 && std::isfinite(tolerance)))
    return Error{Code::bad_option, "tolerance is " + std::to_string(tolerance) + "; choose a length, 0 or more"};
  if (tolerance == 0 || a.size() == 0 || b.size() == 0) return 0.0;
  for (const solid::Body* body : {&a, &b})
    if (tolerance > norm(body->box.hi - body->box.lo) / 4)
      return Error{Code::bad_option, "tolerance is " + std::to_string(tolerance) +
                                         ", more than a quarter of one mesh's size; choose a smaller one"};
  const double scale = std::max(largest_coordinate(a.box), largest_coordinate(b.box));
  return tolerance < clash::kLeastTolerance * scale ? 0 : tolerance;
}

}  // namespace

Result<std::vector<Region>> contact_regions(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b,
                                            const Pose& pose_b, const RegionOptions& options) {
  return guarded([&]() -> Result<std::vector<Region>> {
    const auto find = [&](Options::Find what) {
      return collide(mesh_a, pose_a, mesh_b, pose_b, {.find = what, .threads = options.threads, .stop = options.stop});
    };
    // With a tolerance pairs are found otherwise, below; then this query only checks the arguments.
    const bool is_exact = options.tolerance == 0;
    auto found = find(is_exact ? Options::Find::all : Options::Find::first);
    if (!found) return found.error();
    for (const auto& [mesh, pose, name] : {std::tuple(&mesh_a, &pose_a, "object 0"), {&mesh_b, &pose_b, "object 1"}})
      if (!in_exact_domain(*pose, mesh->state().data)) return not_in_exact_domain(name);
    if (is_exact && found->triangles.empty()) return std::vector<Region>{};
    const solid::Part part_a = solid::make_part(solid::make_body(mesh_a.state().placed(pose_a))),
                      part_b = solid::make_part(solid::make_body(mesh_b.state().placed(pose_b)));
    const auto tolerance = tolerance_for(part_a.body, part_b.body, options);
    if (!tolerance) return tolerance.error();
    if (!is_exact && *tolerance == 0) found = find(Options::Find::all);
    if (!found) return found.error();
    const std::size_t most = clash::most_small_pairs(part_a.body, part_b.body);
    const auto contacts = *tolerance > 0
                              ? clash::contacts_within(part_a.body, part_b.body, *tolerance, most, options.stop)
                              : exact_contacts(*found);
    found = Contacts{};
    if (!contacts)
      return Error{Code::bad_option, "tolerance is " + std::to_string(*tolerance) + ", and more than " +
                                         std::to_string(most) +
                                         " pairs of triangles that are small beside it are no farther apart; choose "
                                         "one below the size of triangles"};
    return clash::regions_of(part_a, part_b, *contacts, *tolerance, on_threads(options.threads), options.stop);
  });
}

}  // namespace impinge
