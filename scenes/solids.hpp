// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "scenes/random.hpp"
#include "scenes/scene.hpp"

/// Small solids whose coordinates are exactly what they seem, so that faces, edges and vertices of two of them meet
/// without an ulp between them. Closed ones are wound so that normals point outwards.
namespace impinge::scenes {

/// A grid of cells with borders at these coordinates, and which of them are filled.
struct Cells {
  std::vector<double> x, y, z;
  std::function<bool(int, int, int)> filled;
};

/// The boundary of the filled cells, two triangles a square, vertices shared. Edges and vertices in which cells meet
/// without sharing a face are used more than twice. Squares are split along one diagonal or, with a seed, along either.
MeshData boundary(const Cells& cells, std::uint64_t seed = 0);

/// A box cut at these coordinates, least and greatest first and last.
MeshData block(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z,
               std::uint64_t seed = 0);

/// The convex hull of points that are not all in one plane; faces are fans, `turn` chooses where they start.
MeshData hull(const std::vector<std::array<int, 3>>& points, int turn = 0);

using Outline = std::vector<std::array<double, 2>>;
/// A regular polygon about the origin; `turn` is a share of the angle between two corners.
Outline regular(int sides, double radius, double turn = 0);
/// A convex outline, counterclockwise, from z = low to high.
MeshData prism(const Outline& outline, double low, double high);
/// What lies between two outlines of as many corners, from z = low to high.
MeshData ring(const Outline& outer, const Outline& inner, double low, double high);

/// A flat sheet at this height, cut at these coordinates.
MeshData sheet(const std::vector<double>& x, const std::vector<double>& y, double z, std::uint64_t seed = 0);

/// Both as one mesh.
MeshData joined(MeshData a, const MeshData& b);
/// Every triangle turned over.
MeshData inverted(MeshData mesh);
/// (x, y, z) to (z, x, y).
MeshData turned(MeshData mesh);
/// The last `n` triangles left out: of an uncut block the last two are its top.
MeshData opened(MeshData mesh, int n = 2);
/// A vertex of its own for each corner of each triangle, as in STL files.
MeshData unshared(const MeshData& mesh);
/// Other orders of vertices, triangles, and corners within a triangle (its side stays).
MeshData shuffled(const MeshData& mesh, Random& random);

}  // namespace impinge::scenes
