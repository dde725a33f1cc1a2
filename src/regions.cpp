// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/regions.hpp"

#include "clash/regions.hpp"
#include "core/guarded.hpp"
#include "impinge/collide.hpp"
#include "mesh_state.hpp"
#include "on_threads.hpp"
#include "solid/locate.hpp"
#include "solid/topology.hpp"

namespace impinge {
namespace {

/// Six times the signed volume, about a corner of the box; in a unit of the box's size, so that nothing overflows.
double signed_volume(const solid::Body& body) {
  const double size = max_component(body.box.hi - body.box.lo);
  const double scale = size > 0 ? std::ldexp(1.0, -std::ilogb(size)) : 1;
  double volume = 0;
  for (std::uint32_t i = 0; i < body.size(); ++i) {
    Triangle t = body.triangle(i);
    for (Vec3& p : t) p = scale * (p - body.box.lo);
    volume += dot(t[0], cross(t[1], t[2]));
  }
  return volume;
}

/// A placed mesh as regions of contact need it.
struct PlacedSide {
  solid::Body body;
  solid::Topology topology;
  std::vector<std::uint8_t> inward;

  PlacedSide(const Mesh& mesh, const Pose& pose)
      : body(solid::make_body({&mesh.state().data, &mesh.state().wide_tree, pose})), topology(solid::examine(body)) {
    if (topology.closed && signed_volume(body) < 0) inward.assign(body.size(), 1);
  }
  [[nodiscard]] clash::Side side() const {
    clash::Side side{body, topology.position, topology.positions, {}, inward};
    if (topology.closed)
      side.holds = [this](const Vec3& point) { return solid::winding_number(body.placed, point).value_or(0) != 0; };
    return side;
  }
};

}  // namespace

Result<std::vector<Region>> contact_regions(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b,
                                            const Pose& pose_b, const MeasureOptions& options) {
  return guarded([&]() -> Result<std::vector<Region>> {
    const auto found = collide(mesh_a, pose_a, mesh_b, pose_b, {.threads = options.threads, .stop = options.stop});
    if (!found) return found.error();
    if (found->triangles.empty()) return std::vector<Region>{};
    std::vector<exact::Contact> contacts;
    contacts.reserve(found->triangles.size());
    for (std::size_t i = 0; i < found->triangles.size(); ++i)
      contacts.push_back({found->triangles[i].a, found->triangles[i].b, found->kinds[i]});
    const PlacedSide a(mesh_a, pose_a), b(mesh_b, pose_b);
    auto regions = clash::regions_of(a.side(), b.side(), contacts, on_threads(options.threads), options.stop);
    if (!regions) return Error{Code::cancelled, "the caller's stop token asked for it"};
    return std::move(*regions);
  });
}

}  // namespace impinge
