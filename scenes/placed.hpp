// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/random.hpp"
#include "scenes/scene.hpp"

/// Scenes in which everything touches, as parts of an assembly do.
namespace impinge::scenes {

/// Two unit cubes, the second one moved by `shift` in its pose: {1, 0, 0} face to face, {1, 1, 0} edge to edge,
/// {1, 1, 1} vertex to vertex, {0, 0, 0} identical.
PlacedScene cube_pair(const std::array<double, 3>& shift);

/// A mesh and itself moved by `shift`, which is added to the second one's vertices.
PlacedScene shifted_pair(const MeshData& mesh, const std::array<double, 3>& shift);

/// A flat grid of n by n unit cells against one of 3 n by 3 n cells of a third, edge to edge and on top of each other:
/// every vertex of the fine one lies on the coarse one, most of them on no vertex of it.
PlacedScene t_junctions(int n);

/// nx * ny * nz unit boxes that fill a lattice, one mesh; each touches up to 26 others.
PlacedScene flush_boxes(int nx, int ny, int nz);

/// 10,000 of them: 25 * 20 * 20.
PlacedScene ten_thousand_flush_boxes();

/// `n` pipes of radius 0.5 and length 1 one behind the other along x, end to end.
PlacedScene pipe_row(int n, int around);

/// `n` copies of `mesh` with random rotations, their origins uniform in a cube of side `side`.
PlacedScene scattered(Random& random, const MeshData& mesh, int n, double side);

}  // namespace impinge::scenes
