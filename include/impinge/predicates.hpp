// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "impinge/measures.hpp"
#include "impinge/mesh.hpp"
#include "impinge/options.hpp"
#include "impinge/result.hpp"

/// The tests of the paper's section 3.4, decided exactly for any doubles below 2^300.
/// All sets are closed: edges have their ends, triangles and polygons their boundary. Degenerate input is the
/// segment or point that it is. The functions set and restore the floating-point environment themselves.
namespace impinge {

/// Sign of the signed area of (a, b, c) in the plane: +1 counter-clockwise, -1 clockwise, 0 collinear.
int orient2d(double ax, double ay, double bx, double by, double cx, double cy);

/// Sign of det(b - a, c - a, d - a): +1 if a, b, c appear counter-clockwise from d's side (d lies on the side that the
/// normal (b - a) x (c - a) points to), -1 on the other side, 0 if coplanar.
int orient3d(const Point& a, const Point& b, const Point& c, const Point& d);

/// Whether the triangle's three vertices are collinear (a segment or a point).
bool is_degenerate(const Triangle& triangle);

/// (1) Whether an edge and a triangle share a point.
bool intersects(const Segment& edge, const Triangle& triangle);

/// (2) Whether an edge and a polygon share a point. The polygon is simple, convex or not, its vertices in order
/// and exactly in one plane. Errors: `bad_mesh` (fewer than 3 vertices, all collinear, or not in one plane).
Result<bool> intersects(const Segment& edge, std::span<const Point> polygon);

/// (3) How the planes of two triangles lie. Errors: `bad_mesh` (a degenerate triangle has no plane).
enum class PlanePair : std::uint8_t { crossing, parallel, same };
Result<PlanePair> classify_planes(const Triangle& a, const Triangle& b);

/// (4) How two triangles meet; nothing if they share no point.
std::optional<Kind> intersects(const Triangle& a, const Triangle& b);

/// Whether two triangles share an area: both proper, coplanar, and their interiors meet.
bool share_area(const Triangle& a, const Triangle& b);

/// (5) The first time t in [0, 1] at which a vertex meets a face, or an edge an edge, if each point moves on a straight
/// line from where it is in `from` (t = 0) to where it is in `to` (t = 1): between equal or neighbouring doubles, and
/// {0, 0} if and only if they meet at the start. Nothing if they never meet. What is degenerate, or becomes so on the
/// way, is the segment or point that it is. From the roots of a cubic (Provot, "Collision and self-collision handling
/// in cloth model dedicated to design garments", 1997), isolated and compared exactly.
std::optional<Interval> vertex_face_impact(const Point& vertex_from, const Triangle& face_from, const Point& vertex_to,
                                           const Triangle& face_to);
std::optional<Interval> edge_edge_impact(const Segment& a_from, const Segment& b_from, const Segment& a_to,
                                         const Segment& b_to);

}  // namespace impinge
