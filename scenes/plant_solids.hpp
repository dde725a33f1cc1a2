// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "scenes/solids.hpp"

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

/// Each triangle cut into four at the middles of its sides: the same points in space where middles are exact.
MeshData subdivided(const MeshData& mesh);
/// The same triangles in another order, with other first corners and other numbers for the vertices.
MeshData renumbered(const MeshData& mesh);

}  // namespace impinge::scenes
