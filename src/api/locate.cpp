// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/locate.hpp"

#include <algorithm>
#include <memory>
#include <string>

#include "core/guarded.hpp"
#include "core/pose.hpp"
#include "impinge/measures.hpp"
#include "pipeline/domain_error.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/options.hpp"
#include "scene/validate_pose.hpp"
#include "solid/location_grid.hpp"
#include "solid/topology.hpp"

namespace impinge {
namespace {

/// The placed mesh if it encloses anything.
Result<solid::Body> closed_body(const Mesh& mesh, const Pose& pose) {
  if (auto valid = scene::validate(pose); !valid) return valid.error();
  const MeshState& state = mesh.state();
  if (!in_range(pose, state.data)) return not_in_range("the mesh");
  solid::Body body = solid::make_body(state.placed(pose));
  const solid::Topology topology = solid::examine(body);
  if (topology.closed) return body;
  return Error{Code::bad_mesh, topology.shells == 0
                                   ? std::string("the mesh has no triangle with an area, so it encloses nothing")
                                   : "the mesh is not closed: it has " + std::to_string(topology.open_edges.size()) +
                                         " open edges; close it, or ask for the distance instead"};
}

Location location(std::optional<bool> winds_around) {
  if (!winds_around) return Location::boundary;
  return *winds_around ? Location::inside : Location::outside;
}

}  // namespace

Result<Location> locate(const Point& point, const Mesh& mesh, const Pose& pose) {
  return guarded([&]() -> Result<Location> {
    if (!in_range(point)) return not_in_range("the point");
    const auto body = closed_body(mesh, pose);
    if (!body) return body.error();
    const auto winding = solid::winding_number(body->placed, point);
    return location(winding ? std::optional(*winding != 0) : std::nullopt);
  });
}

struct PointLocator::State {
  Mesh mesh;
  solid::LocationGrid grid;
};

Result<PointLocator> PointLocator::create(const Mesh& mesh, const Pose& pose, int threads) {
  return guarded([&]() -> Result<PointLocator> {
    if (auto made = mesh.build_tree(threads); !made) return made.error();
    const auto body = closed_body(mesh, pose);
    if (!body) return body.error();
    return PointLocator(std::make_shared<const State>(State{mesh, solid::LocationGrid(*body)}));
  });
}

Result<std::vector<Location>> PointLocator::locate(std::span<const Point> points, const MeasureOptions& options) const {
  return guarded([&]() -> Result<std::vector<Location>> {
    if (auto valid = validate(Options{.threads = options.threads}); !valid) return valid.error();
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!in_range(points[i])) return not_in_range("points[" + std::to_string(i) + "]");
    std::vector<Location> found(points.size());
    constexpr std::size_t kAtOnce = 1024;
    const std::size_t pieces = (points.size() + kAtOnce - 1) / kAtOnce;
    run_each(on_threads(options.threads), pieces, [&](std::size_t piece) {
      if (options.stop.stop_requested()) return;
      const std::size_t end = std::min(points.size(), (piece + 1) * kAtOnce);
      for (std::size_t i = piece * kAtOnce; i < end; ++i) found[i] = location(state_->grid.winds_around(points[i]));
    });
    if (options.stop.stop_requested()) return cancelled();
    return found;
  });
}

}  // namespace impinge
