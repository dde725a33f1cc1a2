// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/predicates.hpp"

#include "core/float_environment.hpp"
#include "exact/edge_polygon.hpp"
#include "exact/orientation.hpp"
#include "exact/segment.hpp"
#include "exact/triangle_pair.hpp"
#include "motion/impact.hpp"

namespace impinge {

int orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const FloatEnvironment nearest;
  return exact::orient2d(ax, ay, bx, by, cx, cy);
}

int orient3d(const Point& a, const Point& b, const Point& c, const Point& d) {
  const FloatEnvironment nearest;
  return exact::orient3d(a, b, c, d);
}

bool is_degenerate(const Triangle& t) {
  const FloatEnvironment nearest;
  return exact::find_projection(t[0], t[1], t[2]) < 0;
}

bool intersects(const Segment& edge, const Triangle& triangle) {
  const FloatEnvironment nearest;
  return exact::find_projection(triangle[0], triangle[1], triangle[2]) < 0
             ? exact::intersects(edge, exact::extremes(triangle))
             : exact::intersects(edge, triangle);
}

Result<bool> intersects(const Segment& edge, std::span<const Point> polygon) {
  const FloatEnvironment nearest;
  if (polygon.size() < 3) return Error{Code::bad_mesh, "a polygon needs at least 3 vertices"};
  const exact::PolygonPlane plane = exact::find_plane(polygon);
  if (plane.projection < 0)
    return Error{Code::bad_mesh, "the polygon's vertices are all on one line; test it as a segment"};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (exact::orient3d(plane.frame[0], plane.frame[1], plane.frame[2], polygon[i]) == 0) continue;
    return Error{Code::bad_mesh, "the polygon's vertex " + std::to_string(i) +
                                     " is not in the plane of the others; cut the polygon into triangles"};
  }
  return exact::intersects(edge, polygon, plane);
}

Result<PlanePair> classify_planes(const Triangle& a, const Triangle& b) {
  const FloatEnvironment nearest;
  for (const Triangle* t : {&a, &b}) {
    if (exact::is_proper(*t)) continue;
    return Error{Code::bad_mesh,
                 std::string(t == &a ? "the first" : "the second") + " triangle is degenerate and has no plane"};
  }
  for (const Point& corner : {b[1], b[2]})
    if (exact::side_of_step(a[0], a[1], a[2], b[0], corner) != 0) return PlanePair::crossing;
  return exact::orient3d(a[0], a[1], a[2], b[0]) == 0 ? PlanePair::same : PlanePair::parallel;
}

std::optional<Kind> intersects(const Triangle& a, const Triangle& b) {
  const FloatEnvironment nearest;
  return exact::classify(a, b);
}

bool share_area(const Triangle& a, const Triangle& b) {
  const FloatEnvironment nearest;
  return exact::share_area(a, b);
}

std::optional<Interval> vertex_face_impact(const Point& vertex_from, const Triangle& face_from, const Point& vertex_to,
                                           const Triangle& face_to) {
  const FloatEnvironment nearest;
  return motion::vertex_face_impact({vertex_from, face_from[0], face_from[1], face_from[2]},
                                    {vertex_to, face_to[0], face_to[1], face_to[2]});
}

std::optional<Interval> edge_edge_impact(const Segment& a_from, const Segment& b_from, const Segment& a_to,
                                         const Segment& b_to) {
  const FloatEnvironment nearest;
  return motion::edge_edge_impact({a_from[0], a_from[1], b_from[0], b_from[1]}, {a_to[0], a_to[1], b_to[0], b_to[1]});
}

}  // namespace impinge
