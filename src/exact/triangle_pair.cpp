// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/triangle_pair.hpp"

#include <utility>

#include "core/shapes.hpp"
#include "exact/orientation.hpp"
#include "exact/segment.hpp"

namespace impinge::exact {
namespace {

using Sides = std::array<int, 3>;  ///< of a triangle's vertices against the other's plane

Sides sides_of(const Triangle& points, const Triangle& plane) {
  Plane p(plane[0], plane[1], plane[2]);
  return {p.side(points[0]), p.side(points[1]), p.side(points[2])};
}

int count(const Sides& s, int side) { return int{s[0] == side} + int{s[1] == side} + int{s[2] == side}; }
bool on_one_side(const Sides& s) { return count(s, 1) == 3 || count(s, -1) == 3; }
bool straddles(const Sides& s) { return count(s, 1) > 0 && count(s, -1) > 0; }

/// The part of a triangle that lies in the other's plane when it does not straddle it: a vertex or an edge.
Segment part_in_plane(const Triangle& t, const Sides& s) {
  std::array<Vec3, 2> ends{};
  int n = 0;
  for (int i = 0; i < 3; ++i)
    if (s[i] == 0) ends[n++] = t[i];
  if (n == 1) ends[1] = ends[0];
  return ends;
}

bool meets_in_plane_of(const Triangle& flat, const Segment& part) {
  return intersects_in_plane(part, flat, kProjections[find_projection(flat[0], flat[1], flat[2])]);
}

/// Turns `t` so that its first vertex lies alone strictly on one side, and says on which.
int turn_lone_vertex_first(Triangle& t, const Sides& s) {
  const int lone_side = count(s, 1) == 1 ? 1 : -1;
  int i = 0;
  while (s[i] != lone_side) ++i;
  t = {t[i], t[(i + 1) % 3], t[(i + 2) % 3]};
  return lone_side;
}

/// Both triangles straddle the other's plane, so each meets the common line in a proper interval, and the order of the
/// intervals' ends is a sign of orient3d (Guigue and Devillers, "Fast and Robust Triangle-Triangle Overlap Test Using
/// Orientation Predicates", 2003). Two ends coincide if and only if the sign is 0, for then the two edges lie in a
/// plane that holds just one point of the line. Relative interiors meet if and only if the open intervals do.
std::optional<Kind> classify_on_line(Triangle a, const Sides& sa, Triangle b, const Sides& sb) {
  const int side_a = turn_lone_vertex_first(a, sa);
  const int side_b = turn_lone_vertex_first(b, sb);
  // Turning a triangle over turns its plane over: bring both lone vertices to the positive side.
  if (side_a < 0) std::swap(b[1], b[2]);
  if (side_b < 0) std::swap(a[1], a[2]);
  const int first = orient3d(a[0], a[1], b[0], b[1]);
  if (first > 0) return std::nullopt;
  const int second = orient3d(a[0], a[2], b[0], b[2]);
  if (second < 0) return std::nullopt;
  return first < 0 && second > 0 ? Kind::crossing : Kind::touching;
}

/// Whether a line along an edge of `a` has all of `b` on its outer side, strictly or (`weakly`) touching it.
bool edge_separates(const Triangle& a, const Triangle& b, const Projection& p, bool weakly) {
  const int turn = orient2d(p, a[0], a[1], a[2]);
  for (int i = 0; i < 3; ++i) {
    bool outside = true;
    for (int j = 0; j < 3 && outside; ++j) {
      const int side = turn * orient2d(p, a[i], a[(i + 1) % 3], b[j]);
      outside = side < 0 || (weakly && side == 0);
    }
    if (outside) return true;
  }
  return false;
}

std::optional<Kind> classify_degenerate(const Triangle& a, bool a_proper, const Triangle& b, bool b_proper) {
  const bool meet = a_proper   ? intersects(extremes(b), a)
                    : b_proper ? intersects(extremes(a), b)
                               : intersects(extremes(a), extremes(b));
  return meet ? std::optional(Kind::touching) : std::nullopt;
}

bool is_proper(const Triangle& t) { return find_projection(t[0], t[1], t[2]) >= 0; }

}  // namespace

std::optional<Kind> classify(const Triangle& a, const Triangle& b) {
  if (!overlap(box_of(a), box_of(b))) return std::nullopt;

  const Sides sa = sides_of(a, b);
  if (on_one_side(sa)) return std::nullopt;
  const Sides sb = sides_of(b, a);
  if (on_one_side(sb)) return std::nullopt;
  // A side other than 0 proves the plane's triangle proper.
  const bool a_proper = count(sb, 0) < 3 || is_proper(a);
  const bool b_proper = count(sa, 0) < 3 || is_proper(b);
  if (!a_proper || !b_proper) return classify_degenerate(a, a_proper, b, b_proper);

  if (count(sa, 0) == 3) {
    const Projection& p = kProjections[find_projection(a[0], a[1], a[2])];
    if (edge_separates(a, b, p, false) || edge_separates(b, a, p, false)) return std::nullopt;
    return Kind::coplanar;
  }
  if (straddles(sa) && straddles(sb)) return classify_on_line(a, sa, b, sb);
  const bool meet =
      straddles(sa) ? meets_in_plane_of(a, part_in_plane(b, sb)) : meets_in_plane_of(b, part_in_plane(a, sa));
  return meet ? std::optional(Kind::touching) : std::nullopt;
}

bool share_area(const Triangle& a, const Triangle& b) {
  const int projection = find_projection(a[0], a[1], a[2]);
  if (projection < 0 || !is_proper(b) || count(sides_of(b, a), 0) < 3) return false;
  const Projection& p = kProjections[projection];
  return !edge_separates(a, b, p, true) && !edge_separates(b, a, p, true);
}

}  // namespace impinge::exact
