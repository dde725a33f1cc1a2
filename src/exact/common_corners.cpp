// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/common_corners.hpp"

#include <algorithm>
#include <cmath>

#include "exact/orientation.hpp"
#include "exact/segment.hpp"
#include "exact/triangle_pair.hpp"

namespace impinge::exact {
namespace {

/// The edge opposite to a corner.
Segment opposite(const Triangle& t, std::size_t corner) { return {t[(corner + 1) % 3], t[(corner + 2) % 3]}; }

/// Whether a segment from p and a triangle with corner p share another point: what they share is convex, so it goes on
/// from p to the segment's end or to where it leaves the triangle, which is at the edge opposite to p.
bool segment_meets_beyond(const Vec3& p, const Vec3& end, const Triangle& t, std::size_t corner) {
  if (end == p) return false;
  const Segment edge = opposite(t, corner);
  if (is_proper(t)) return intersects(Segment{end, end}, t) || intersects(Segment{p, end}, edge);
  for (const Vec3& other : edge)  // the triangle is the segments from p to its other corners
    if (!(other == p) && (intersects(end, Segment{p, other}) || intersects(other, Segment{p, end}))) return true;
  return false;
}

double largest(const Vec3& v) { return max_component(abs(v)); }

/// Certain that two triangles share no more than the corner from which q and r, s and t lead to their other corners:
/// the usual case. False where floating point cannot tell, and for degenerate triangles.
//
// With u = 2^-53, and Q to T the largest coordinates of q to t: the differences are off by u each, so det(s, t, q), six
// products of three, is off by less than 48 u S T Q (Shewchuk's bound for orient3d, 7 u and a little of the permanent,
// which is at most 6 S T Q). Where both corners of a triangle are strictly on one side of the other's plane, only the
// common corner is in it. Where neither's are, either triangle meets the line of both planes in a segment from the
// common corner, towards a = |det r| q + |det q| r and b = |det t| s + |det s| t: these point opposite ways, or else
// the triangles share more. Each coordinate of a is off by less than e_a = (Q + R) e + 4 u A, A being at least its
// size, and of b likewise; so a . b is off by less than 3 (A e_b + B e_a + e_a e_b + 4 u A B). Out of 2^-80 to 2^80,
// where products might underflow or overflow, all is left open.
bool surely_part_at_corner(const Vec3& q, const Vec3& r, const Vec3& s, const Vec3& t) {
  constexpr double u = 0x1p-53;
  const double Q = largest(q), R = largest(r), S = largest(s), T = largest(t);
  const double least = std::min({Q, R, S, T});
  if (!(least > 0x1p-80 && std::max({Q, R, S, T}) < 0x1p80)) return false;
  const Vec3 across_b = cross(s, t), across_a = cross(q, r);
  const double error_a = 48 * u * S * T * std::max(Q, R), error_b = 48 * u * Q * R * std::max(S, T);
  const double det_q = dot(across_b, q), det_r = dot(across_b, r), det_s = dot(across_a, s), det_t = dot(across_a, t);
  const auto on_one_side = [](double x, double y, double error) {
    return (x > error && y > error) || (x < -error && y < -error);
  };
  if (on_one_side(det_q, det_r, error_a) || on_one_side(det_s, det_t, error_b)) return true;
  const auto on_both_sides = [](double x, double y, double error) {
    return (x > error && y < -error) || (x < -error && y > error);
  };
  if (!on_both_sides(det_q, det_r, error_a) || !on_both_sides(det_s, det_t, error_b)) return false;
  const Vec3 a = std::abs(det_r) * q + std::abs(det_q) * r, b = std::abs(det_t) * s + std::abs(det_s) * t;
  const double A = std::abs(det_r) * Q + std::abs(det_q) * R, B = std::abs(det_t) * S + std::abs(det_s) * T;
  const double e_a = (Q + R) * error_a + 4 * u * A, e_b = (S + T) * error_b + 4 * u * B;
  return dot(a, b) < -3.001 * (A * e_b + B * e_a + e_a * e_b + 4 * u * A * B);
}

/// Whether two triangles with one common corner share another point.
bool meet_beyond_corner(const Triangle& a, std::size_t corner_a, const Triangle& b, std::size_t corner_b) {
  const Segment edge_a = opposite(a, corner_a), edge_b = opposite(b, corner_b);
  const Vec3& p = a[corner_a];
  if (surely_part_at_corner(edge_a[0] - p, edge_a[1] - p, edge_b[0] - p, edge_b[1] - p)) return false;
  // What they share is convex, so it goes on from the corner to where it leaves the first of them, which is at the edge
  // opposite to the corner.
  const bool is_proper_a = is_proper(a), is_proper_b = is_proper(b);
  if (is_proper_a && is_proper_b) return intersects(edge_a, b) || intersects(edge_b, a);
  if (!is_proper_a)  // it is the segments from the corner to its other corners
    return segment_meets_beyond(a[corner_a], edge_a[0], b, corner_b) ||
           segment_meets_beyond(a[corner_a], edge_a[1], b, corner_b);
  return segment_meets_beyond(b[corner_b], edge_b[0], a, corner_a) ||
         segment_meets_beyond(b[corner_b], edge_b[1], a, corner_a);
}

/// Whether two triangles with the common corners p and q, and c and d beside, share a point outside of the segment pq.
bool meet_beyond_edge(const Triangle& a, const Triangle& b, const Vec3& p, const Vec3& q, const Vec3& c,
                      const Vec3& d) {
  if (orient3d(p, q, c, d) != 0) return false;
  const bool is_proper_a = is_proper(a), is_proper_b = is_proper(b);
  if (is_proper_a && is_proper_b) return share_area(a, b);
  if (is_proper_a || is_proper_b) return false;  // a proper triangle has no more than pq on that line
  const auto both_beyond = [&](const Vec3& from, const Vec3& end) {
    const auto is_beyond = [&](const Vec3& v) { return !(v == end) && intersects(end, Segment{from, v}); };
    return is_beyond(c) && is_beyond(d);
  };
  return both_beyond(p, q) || both_beyond(q, p);
}

}  // namespace

bool meet_beyond(const Triangle& a, const Triangle& b, const CommonCorners& common) {
  if (common.size == 3) return true;
  const Vec3 &p = a[common.a[0]], &q = a[common.a[1]];
  // Two vertices in one place, told apart by their indices, have one point for their hull.
  if (common.size == 1 || p == q) return meet_beyond_corner(a, common.a[0], b, common.b[0]);
  return meet_beyond_edge(a, b, p, q, a[3 - common.a[0] - common.a[1]], b[3 - common.b[0] - common.b[1]]);
}

}  // namespace impinge::exact
