// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/mesh.hpp"
#include "impinge/result.hpp"

namespace impinge {

struct RegionOptions {
  /// 0: exactly. Above 0, what comes within it is in contact, so that flush faces are where they were meant to be:
  /// world vertices are rounded, and after a rotation flush faces cross by an ulp or are apart by one. Choose one far
  /// below the size of triangles and the thickness of walls; 2^-20 of the largest |coordinate| serves. What a larger
  /// one means is said below.
  double tolerance = 0;
  int threads = 0;  ///< at most so many; 0: all there are
  std::stop_token stop{};
};

/// One connected region of contact between two placed meshes. What a pair of triangles shares is a point, a segment or
/// (if they are coplanar) a convex polygon. Which corners that has is decided exactly, and each coordinate of a corner
/// is the double nearest to the exact one. Sums over them are taken in double, about the middle of the box. A closed
/// mesh may have its normals outwards or all of them inwards; of an open one, the side that its triangles' normals look
/// to counts as outside.
struct Region {
  std::uint64_t pairs = 0;     ///< of triangles
  std::array<Point, 2> box{};  ///< lowest and highest corner of what the pairs share
  /// That of the polygons that coplanar pairs share, and that of the patch that each closed line of crossing spans:
  /// the length of half the integral of r x dr along it, which for a plane line is the area that it encloses. Each line
  /// counts by itself: a bolt through a plate has an area at either face.
  double area = 0;
  double length = 0;  ///< of the lines
  /// Of the area; without area of the lines; without lines the mean of the points.
  Point centroid{};
  /// Unit: the way in which b must go to leave a, or {0, 0, 0} where contact says none. Exchanging a and b turns it
  /// round. With area, the direction of the sum of: for each polygon, half of its area times (outward normal of a -
  /// outward normal of b); for each closed line of crossing, the integral of a's outward normal over the part of a's
  /// surface inside b that it bounds. (Through a plate the two faces cancel: 0.) Without area: the mean outward normal
  /// of the triangles of a in contact if they all look one way; or else the opposite of b's if those do; or else the
  /// difference of both means.
  Point normal{};
  /// First the lines in which the surfaces cross or touch, then the outlines of the area that polygons cover together.
  /// A closed line ends with the point with which it begins. Which end is the first says nothing.
  std::vector<std::vector<Point>> lines;
  std::vector<std::uint32_t> triangles_a, triangles_b;  ///< those in some pair, sorted
};

/// The regions of contact between a and b, largest first: by area, then length, then pairs, then the first pair in
/// canonical order. Two pairs of triangles belong to one region if in both meshes their triangles are the same or
/// neighbours (have a vertex in common, by equal world coordinates), if what they share has a corner in common, or if
/// a part of one surface that lies inside the other mesh leads from one to the other: a bolt through a plate is one
/// region. Only closed meshes have an inside. (That part is told by points which are rounded: where it is narrower than
/// rounding, regions may stay apart.) The same for every number of threads.
///
/// With a tolerance t, pairs of triangles count that are no farther than t apart, and what they share is taken within
/// t:
///   - Flush triangles share the polygon over which they lie, half-way between them. They are flush if their planes are
///     no more than 25 degrees apart, and they no more than t wherever one lies over the other. So a region has the
///     area, outline, centroid and normal of the flush faces: points are off by t at most, the area by t times the
///     length of its outlines.
///   - An edge that is within t wherever it lies over a triangle, for more than 4 t, is a line; what crosses or touches
///     otherwise is as it is exactly; and what is only near shares the point between the nearest points.
///   - Points that gaps and rounding have parted, by little more than t at most, become one of them; and what comes
///     within t belongs together.
///   - Lines and outlines are told no more coarsely than the triangles are: where t is above a quarter of their width
///     (the radius of the circle within, 2 area / perimeter; of those in contact the median, a's or b's, the smaller
///     one), that quarter stands for it in the rules on lines and on points that become one, t / 256 at least. So a t
///     of the size of triangles, or above it, leaves flush faces their area and outline. Across a gap above that
///     quarter the same goes for plane faces and for those of many triangles, whose normals differ little from one to
///     the next; elsewhere neighbouring polygons may stay apart by a part of the gap, and have lines between them.
/// What surfaces that cross share is told less surely than what flush ones do: where they do so at a small angle and an
/// edge of either lies within t of the other, that edge stands for the line of crossing beside it, and the line round
/// the region may stay open. Then the area is less than what the region encloses, or 0, and the normal may be {0, 0,
/// 0}. With tolerance 0 lines of crossing close and have their areas, and `ContactManifolds` (impinge/manifolds.hpp)
/// goes by them. A tolerance below 2^-36 of the largest |coordinate| is below what rounding leaves, and taken as 0.
/// Errors: as `collide`; `bad_option` (tolerance negative, not finite, or above a quarter of the diagonal of either
/// box; or so large that more than 2^20 pairs and 64 for each triangle are within it of triangles without an edge above
/// 4 t).
Result<std::vector<Region>> contact_regions(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b,
                                            const Pose& pose_b, const RegionOptions& options = {});

}  // namespace impinge
