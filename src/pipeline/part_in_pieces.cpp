// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/part_in_pieces.hpp"

#include <utility>

#include "core/pose.hpp"
#include "pipeline/mesh_state.hpp"
#include "solid/classed_pieces.hpp"

namespace impinge {
namespace {

solid::Body placed_body(const Mesh& mesh, const Pose& pose) {
  return solid::make_body({&mesh.state().data, &mesh.state().wide_tree, pose});
}

/// The piece's triangles as a mesh, with the vertices that they use.
Mesh mesh_of_piece(const Mesh& whole, const solid::ClassedPiece& piece) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> number(whole.vertex_count(), kUnused), triangles;
  std::vector<double> xyz;
  for (const auto& triangle : piece.triangles) {
    for (const std::uint32_t v : triangle) {
      if (number[v] == kUnused) {
        number[v] = static_cast<std::uint32_t>(xyz.size() / 3);
        const Point& vertex = whole.vertices()[v];
        xyz.insert(xyz.end(), {vertex.x, vertex.y, vertex.z});
      }
      triangles.push_back(number[v]);
    }
  }
  return Mesh::create(std::span<const double>(xyz), triangles).value();
}

}  // namespace

PartInPieces place_in_pieces(const Mesh& mesh, const Pose& pose, const std::stop_token& stop) {
  const solid::Body own = placed_body(mesh, {});
  PartInPieces result;
  result.part.whole = placed_body(mesh, pose);
  for (const solid::ClassedPiece& piece : solid::classed_pieces(own, solid::examine(own), stop)) {
    result.meshes.push_back(mesh_of_piece(mesh, piece));
    clash::PlacedPiece placed{placed_body(result.meshes.back(), pose), piece.part_class, piece.inner_points,
                              piece.radius};
    for (solid::InnerPoint& inner : placed.inner_points) pose_all_vertices(pose, {&inner.point, 1});
    if (piece.part_class == PartClass::cracked) {
      placed.frame = local_frame(placed.body.box, placed.body.box);
      std::vector<Triangle> triangles;
      for (std::uint32_t t = 0; t < placed.body.size(); ++t)
        triangles.push_back(placed.frame.to_local(placed.body.triangle(t)));
      placed.tree.emplace(std::move(triangles), stop);
    }
    result.part.pieces.push_back(std::move(placed));
  }
  return result;
}

}  // namespace impinge
