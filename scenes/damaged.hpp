// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/random.hpp"
#include "scenes/scene.hpp"

/// Solids damaged as exporters damage them, and open shapes that no winding number should take for solids.
namespace impinge::scenes {

/// Each plane face, triangles that hang together across edges without a bend, with vertices of its own, moved in some
/// direction by half of `gap` at most.
MeshData faces_apart(const MeshData& mesh, double gap, Random& random);
/// A share of the triangles cut in two at the middle of an edge, of which the neighbour knows nothing.
MeshData with_t_junctions(const MeshData& mesh, double share, Random& random);
/// A share of the triangles left out, at least one.
MeshData with_triangles_missing(const MeshData& mesh, double share, Random& random);
/// A share of the triangles turned over.
MeshData with_triangles_flipped(const MeshData& mesh, double share, Random& random);
/// One plane face, that of a random triangle, turned over.
MeshData with_a_face_flipped(const MeshData& mesh, Random& random);
/// A cylinder about the z axis whose wall has another number of facets than its caps: nothing meets along the seams.
MeshData mismatched_cylinder(int around_wall, int around_caps, double radius, double height);
/// A band with half a turn, of so many squares in a ring about the z axis: no way of turning its triangles agrees.
MeshData moebius_band(int around);
/// Each triangle twice, once for each side.
MeshData two_sided(const MeshData& mesh);

struct DamagedSolid {
  std::string name;
  MeshData sound, damaged;
  double damage = 0;     ///< no point of the boundary was moved farther, and no missing triangle is wider
  bool is_open = false;  ///< some edge is open even after triangles are turned to agree
};

/// Blocks, balls, tubes and others in every way of damage, with sizes around 1.
std::vector<DamagedSolid> damaged_solids(std::uint64_t seed);

struct OpenShape {
  std::string name;
  MeshData mesh;
};
/// Cups, ducts short and long, coarse and fine, boxes and plates without a face, sheets.
std::vector<OpenShape> open_shapes();

}  // namespace impinge::scenes
