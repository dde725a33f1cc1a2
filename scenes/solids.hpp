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
#include <map>
#include <span>
#include <vector>

#include "scenes/scene.hpp"

/// Closed meshes as parts of machines are: flat sections that are extruded in layers, and profiles that are revolved.
/// Every vertex is shared, every edge is met twice, no two triangles meet but in a common edge or corner. Normals point
/// outwards.
namespace impinge::scenes {

using Flat = std::array<double, 2>;
using Loop = std::vector<Flat>;  ///< a polygon, counterclockwise

/// The nearest multiple of 2^-10. What is made here keeps to them, so that it is the same in single precision (below
/// 2^14) and sums with such a shift are exact.
double snapped(double x);

/// A regular polygon whose first side crosses the positive x axis at a right angle; with 4, 8, 12 .. corners there is
/// such a side across every half-axis. Each coordinate snapped.
Loop circle(double radius, int n, const Flat& center = {0, 0});
/// How far those sides are from the center.
double flat_of(double radius, int n);

/// A region of the plane cut into triangles, each of a zone 0 to 31. Points are told apart by their coordinates, so
/// pieces that are put side by side hang together where they share them.
struct Section {
  std::vector<Flat> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<unsigned> zones;  ///< of each triangle

  /// A convex polygon.
  void fill(const Loop& loop, unsigned zone);
  /// What lies between two polygons around one center, which sees both of them whole.
  void fill_between(const Loop& outer, const Loop& inner, unsigned zone);

 private:
  std::uint32_t add(const Flat& point);
  std::map<Flat, std::uint32_t> known_;
};

/// Cells of the grid with these lines, row by row from below: the zone of each, -1 where nothing is. Two cells that
/// meet in a corner alone would not make a proper solid.
Section grid_section(std::span<const double> xs, std::span<const double> ys, std::span<const int> zones);

/// The solid that fills the zones of mask `layers[k]` (bit z: zone z) between heights zs[k] and zs[k + 1].
MeshData layered(const Section& section, std::span<const double> zs, std::span<const unsigned> layers);
/// All zones between the first height and the last, `along` layers.
MeshData extruded(const Section& section, double low, double high, int along = 1);

/// A profile (r, z) turned around the z axis, n sides placed as those of `circle`. It starts and ends on the axis,
/// upwards, and is off it between.
MeshData revolved(const Loop& profile, int n);
/// A polygon (r, z) off the axis turned around it: a ring.
MeshData revolved_ring(const Loop& profile, int n);

/// The mesh turned inside out.
MeshData inverted(MeshData mesh);
/// The triangles of both: the second one a shell of its own.
MeshData joined(MeshData mesh, const MeshData& shell);
/// Each triangle cut into four at the middles of its sides: the same points in space where middles are exact.
MeshData subdivided(const MeshData& mesh);
/// The same triangles in another order, with other first corners and other numbers for the vertices.
MeshData renumbered(const MeshData& mesh);

}  // namespace impinge::scenes
