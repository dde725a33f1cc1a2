// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>

#include "scenes/scene.hpp"

/// Well-formed shapes. Closed ones are wound so that normals point outwards.
namespace impinge::scenes {

/// A tube of radius 0.4 around the (p, q) torus knot on the torus of radii 2 and 1: 2 * along * around triangles.
MeshData torus_knot(int p, int q, int along, int around);

/// The same with about `triangles` triangles (exactly so many for 968, 3162, 5200, 7590 and 9612), in rings of at least
/// five and as near as possible to six times as many rings as points on a ring.
MeshData torus_knot_of(int triangles, int p = 2, int q = 3);

/// Centred on the origin: 2 * slices * (stacks - 1) triangles.
MeshData uv_sphere(int slices, int stacks, double radius = 1);

/// [low, high] with `n` cells along each edge, 12 n^2 triangles, vertices shared.
MeshData box(const std::array<double, 3>& low, const std::array<double, 3>& high, int n = 1);

/// [0, 1]^3: 12 triangles.
MeshData cube();

/// The height of a grid's vertex (i, j).
using Height = std::function<double(int, int)>;

/// nx by ny square cells of side `cell`, two triangles each, from the origin in the xy plane.
MeshData grid(int nx, int ny, double cell, const Height& height);
MeshData flat_grid(int nx, int ny, double cell = 1);

/// Heights 0, 1/16 .. 7/16 of a cell, in a pattern of period 8 along both axes.
MeshData bumpy_grid(int nx, int ny, double cell = 1);

/// A tube around the z axis from 0 to `length`: 2 * around * along triangles, and 2 * around more when capped.
MeshData pipe(int around, int along, double radius, double length, bool capped);

/// Every coordinate multiplied and every vertex moved, in double.
MeshData scaled(MeshData mesh, double sx, double sy, double sz);
MeshData shifted(MeshData mesh, double dx, double dy, double dz);

}  // namespace impinge::scenes
