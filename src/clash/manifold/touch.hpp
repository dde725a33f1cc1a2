// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "clash/manifold/shared_points.hpp"
#include "core/local_frame.hpp"
#include "core/mesh_data.hpp"
#include "core/pose.hpp"
#include "solid/topology.hpp"

namespace impinge::clash {

/// A placed mesh as manifolds see it.
struct PlacedSurface {
  const MeshData* mesh;
  const solid::Topology* topology;  ///< in the mesh's own frame
  bool is_inward;                   ///< closed, with its normals inwards
  Pose pose;
  LocalFrame frame;  ///< one for both surfaces of a pair

  [[nodiscard]] Vec3 local_vertex(std::uint32_t vertex) const {
    Vec3 world;
    pose_vertices(pose, mesh->vertices, {&vertex, 1}, &world);
    return frame.to_local(world);
  }
  /// With its normal outwards.
  [[nodiscard]] Facet facet(std::uint32_t triangle) const {
    Facet facet;
    pose_vertices(pose, mesh->vertices, mesh->triangles[triangle], facet.corners.data());
    facet.corners = frame.to_local(facet.corners);
    facet.normal = unit_or_zero(cross(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]));
    if (is_inward) facet.normal = -1.0 * facet.normal;
    return facet;
  }
};

/// Two triangles in contact, in the local frame.
struct Touch {
  std::array<std::uint32_t, 2> triangles;
  std::array<Vec3, 2> normals;
  SharedPoints shared;
  std::uint32_t region;  ///< the lowest touch of it

  [[nodiscard]] bool has_length() const { return shared.size == 2; }
  [[nodiscard]] bool is_flush() const { return shared.size > 2; }
  [[nodiscard]] bool is_parallel() const { return are_parallel(normals[0], normals[1]); }
};

}  // namespace impinge::clash
