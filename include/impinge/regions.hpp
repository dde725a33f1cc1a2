// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/measures.hpp"
#include "impinge/mesh.hpp"
#include "impinge/result.hpp"

namespace impinge {

/// One connected region of contact between two placed meshes. What a pair of triangles shares is a point, a segment or
/// (of coplanar triangles) a convex polygon. Which corners that has is decided exactly, and each corner's coordinates
/// are the doubles nearest to the exact ones. Sums are taken of these in double, about the middle of the box; with
/// "out" and "outward" a closed mesh is meant to have its normals outwards, or all of them inwards.
struct Region {
  std::uint64_t pairs = 0;     ///< of triangles
  std::array<Point, 2> box{};  ///< lowest and highest corner of what the pairs share
  /// Of the polygons that coplanar pairs share, each counted once a pair; and of each closed line in which surfaces
  /// cross, the area of the patch that it spans: half the length of its integral of r x dr, which is the area inside it
  /// where it lies in a plane.
  double area = 0;
  double length = 0;  ///< of the lines
  /// Of the area; without area of the lines; without lines the mean of the points.
  Point centroid{};
  /// Unit: the way in which b would have to go to leave a, or {0, 0, 0} where contact says none. Exchanging a and b
  /// turns it round. With area: the mean over the area of the polygons' (outward normal of a - outward normal of b) /
  /// 2, and, for each closed crossing line, the integral of a's outward normal over the part of a's surface that it
  /// cuts off inside b (both sides of a hole weigh each other up: through a plate no way is the best). Without area:
  /// the mean outward normal of the touched triangles of a if they all look one way, or else the opposite of b's if
  /// those do, or else the difference of both means.
  Point normal{};
  /// Where the surfaces meet: first the lines in which they cross or touch, then the outlines of polygons that share
  /// borders. A closed line ends with the point with which it begins, and has no direction of its own.
  std::vector<std::vector<Point>> lines;
  std::vector<std::uint32_t> triangles_a, triangles_b;  ///< those in some pair, sorted
};

/// The regions of contact between a and b, largest first: by area, then length, then pairs, then the first pair in
/// canonical order. Two pairs of triangles belong to one region if in each mesh their triangles are the same or
/// neighbours (have a vertex in common, by equal world coordinates), if what they share has a corner in common, or if a
/// piece of an edge or an edge-connected part of one surface leads from one to the other inside the other mesh, which
/// must be closed for that: a bolt through a plate is one region.
/// The same for every number of threads. Errors: as `collide`.
Result<std::vector<Region>> contact_regions(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b,
                                            const Pose& pose_b, const MeasureOptions& options = {});

}  // namespace impinge
