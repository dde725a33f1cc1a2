// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/edge_polygon.hpp"

#include "exact/segment.hpp"

namespace impinge::exact {
namespace {

Segment side(std::span<const Vec3> polygon, std::size_t i) { return {polygon[i], polygon[(i + 1) % polygon.size()]}; }

/// Winding number of the polygon about a point, by crossings of a ray (Sunday's rule: upward sides include their lower
/// end, downward ones their upper). `above` tells a vertex above the ray's line, `left` on which side of a polygon side
/// the point lies.
template <class Above, class Left>
bool winds_around(std::size_t n, const Above& above, const Left& left) {
  int winding = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool from = above(i), to = above((i + 1) % n);
    if (!from && to && left(i) > 0) ++winding;
    if (from && !to && left(i) < 0) --winding;
  }
  return winding != 0;
}

bool contains_in_plane(std::span<const Vec3> polygon, const Projection& p, const Vec3& point) {
  return winds_around(
      polygon.size(), [&](std::size_t i) { return component(polygon[i], p.v) > component(point, p.v); },
      [&](std::size_t i) { return orient2d(p, side(polygon, i)[0], side(polygon, i)[1], point); });
}

/// The edge's ends lie strictly on both sides of the plane. Seen along the edge the polygon is a plane figure and the
/// edge a point; the ray runs in the plane through the edge and a vertex that is not on the edge's line.
bool contains_crossing(const Segment& edge, std::span<const Vec3> polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (intersects(edge, side(polygon, i))) return true;
  std::size_t reference = 0;
  while (find_projection(edge[0], edge[1], polygon[reference]) < 0) ++reference;
  return winds_around(
      polygon.size(), [&](std::size_t i) { return orient3d(edge[0], edge[1], polygon[reference], polygon[i]) > 0; },
      [&](std::size_t i) { return orient3d(edge[0], edge[1], side(polygon, i)[0], side(polygon, i)[1]); });
}

}  // namespace

PolygonPlane find_plane(std::span<const Vec3> polygon) {
  std::size_t second = 0;
  while (second < polygon.size() && polygon[second] == polygon[0]) ++second;
  for (std::size_t third = second + 1; third < polygon.size(); ++third) {
    const int projection = find_projection(polygon[0], polygon[second], polygon[third]);
    if (projection >= 0) return {{polygon[0], polygon[second], polygon[third]}, projection};
  }
  return {{}, -1};
}

bool intersects(const Segment& edge, std::span<const Vec3> polygon, const PolygonPlane& plane) {
  const auto& [frame, projection] = plane;
  const int s0 = orient3d(frame[0], frame[1], frame[2], edge[0]);
  const int s1 = orient3d(frame[0], frame[1], frame[2], edge[1]);
  if (s0 * s1 > 0) return false;
  if (s0 * s1 < 0) return contains_crossing(edge, polygon);
  const Segment in_plane{s0 == 0 ? edge[0] : edge[1], s1 == 0 ? edge[1] : edge[0]};
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (intersects(in_plane, side(polygon, i))) return true;
  return contains_in_plane(polygon, kProjections[projection], in_plane[0]);
}

}  // namespace impinge::exact
