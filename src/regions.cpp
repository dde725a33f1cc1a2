// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/regions.hpp"

#include <utility>

#include "clash/region_side.hpp"
#include "core/guarded.hpp"
#include "impinge/collide.hpp"
#include "mesh_state.hpp"
#include "on_threads.hpp"
#include "solid/part.hpp"

namespace impinge {
namespace {

/// Whether the mesh crosses itself is not asked: whatever is closed encloses something.
solid::Part part_of(const Mesh& mesh, const Pose& pose) {
  solid::Body body = solid::make_body({&mesh.state().data, &mesh.state().wide_tree, pose});
  solid::Topology topology = solid::examine(body);
  const bool closed = topology.closed;
  return solid::make_part(std::move(body), std::move(topology), closed);
}

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
    const solid::Part part_a = part_of(mesh_a, pose_a), part_b = part_of(mesh_b, pose_b);
    const clash::RegionSide a(part_a), b(part_b);
    auto regions = clash::regions_of(a.side(), b.side(), contacts, on_threads(options.threads), options.stop);
    if (!regions) return Error{Code::cancelled, "the caller's stop token asked for it"};
    return std::move(*regions);
  });
}

}  // namespace impinge
