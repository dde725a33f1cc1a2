// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/locate.hpp"

#include <string>

#include "core/guarded.hpp"
#include "core/pose.hpp"
#include "impinge/measures.hpp"
#include "pipeline/domain_error.hpp"
#include "pipeline/mesh_state.hpp"
#include "scene/validate_pose.hpp"
#include "solid/topology.hpp"

namespace impinge {

Result<Location> locate(const Point& point, const Mesh& mesh, const Pose& pose) {
  return guarded([&]() -> Result<Location> {
    if (auto valid = scene::validate(pose); !valid) return valid.error();
    const MeshState& state = mesh.state();
    if (!in_exact_domain(pose, state.data)) return out_of_domain("the mesh");
    if (!in_exact_domain(point)) return out_of_domain("the point");
    const hierarchy::PlacedTree placed{&state.data, &state.wide_tree, pose};
    const solid::Topology topology = solid::examine(solid::make_body(placed));
    if (!topology.closed)
      return Error{Code::bad_mesh, topology.shells == 0
                                       ? std::string("the mesh has no triangle with an area, so it encloses nothing")
                                       : "the mesh is not closed: it has " +
                                             std::to_string(topology.open_edges.size()) +
                                             " open edges; close it, or ask for the distance instead"};
    const auto winding = solid::winding_number(placed, point);
    if (!winding) return Location::boundary;
    return *winding != 0 ? Location::inside : Location::outside;
  });
}

}  // namespace impinge
