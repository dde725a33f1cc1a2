// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/reach.hpp"

#include <algorithm>
#include <cmath>

#include "clash/depth.hpp"
#include "clash/surface_reach.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

Interval larger(const Interval& p, const Interval& q) { return {std::max(p.lo, q.lo), std::max(p.hi, q.hi)}; }

/// Where the lower ends say so: no tolerance excuses what reaches in by more than half of the other's radius, both
/// ways.
bool go_through(const PlacedPiece& a, const PlacedPiece& b, const Interval& a_in_b, const Interval& b_in_a) {
  const auto is_deep = [](const Interval& depth, const PlacedPiece& outer) { return depth.lo > outer.radius / 2; };
  if (a.has_inside() && b.has_inside()) return is_deep(a_in_b, b) && is_deep(b_in_a, a);
  return b.has_inside() ? is_deep(a_in_b, b) : a.has_inside() && is_deep(b_in_a, a);
}

/// The greatest distance from the outer piece's triangles of those points of the inner piece's triangles that lie in
/// it.
Interval reach_of_triangles(const PlacedPiece& inner, const PlacedPiece& outer, const ReachGoal& goal) {
  if (!outer.has_inside() || is_empty(intersection(inner.body.box, outer.body.box))) return {};
  const Winding winding{[&](const Vec3& point) { return outer.winding(point); }, outer.part_class == PartClass::solid};
  DepthGoal depth{.precision = goal.precision, .stop = goal.stop};
  if (!winding.closed) {
    // Cracks are as wide as what single precision leaves, or wider; and winding numbers cost more beside them.
    depth.nothing = 0x1p-20 * norm(outer.body.box.hi - outer.body.box.lo);
    depth.most_points /= 8;
  }
  return depth_in(inner.body, outer.body, winding, depth);
}

/// The largest radius of the outer piece's inner points that the inner piece's material holds: pieces may coincide, and
/// then no triangle lies inside.
Interval reach_of_material(const PlacedPiece& inner, const PlacedPiece& outer, double known) {
  double largest = 0;
  if (inner.has_inside())
    for (const solid::InnerPoint& point : outer.inner_points)
      if (point.radius > std::max(known, largest) && inner.holds(point.point)) largest = point.radius;
  return {largest, largest};
}

}  // namespace

double PlacedPiece::winding(const Vec3& point) const {
  if (part_class == PartClass::solid) return std::abs(solid::winding_number(body.placed, point).value_or(0));
  return tree ? std::abs(tree->winding_number(frame.to_local(point))) : 0;
}

bool PlacedPart::has_inside() const {
  return std::any_of(pieces.begin(), pieces.end(), [](const PlacedPiece& piece) { return piece.has_inside(); });
}

double PlacedPart::radius() const {
  double largest = 0;
  for (const PlacedPiece& piece : pieces) largest = std::max(largest, piece.radius);
  return largest;
}

double PlacedPart::winding(const Vec3& point) const {
  double most = 0;
  for (const PlacedPiece& piece : pieces) most = std::max(most, piece.winding(point));
  return most;
}

double PairReach::fails_below() const { return through ? kInfinity : std::max({a_in_b.lo, b_in_a.lo, crossing}); }

PairReach reach_between(const PlacedPart& a, const PlacedPart& b, const ReachGoal& goal) {
  PairReach reach;
  for (const PlacedPiece& p : a.pieces) {
    for (const PlacedPiece& q : b.pieces) {
      if (goal.stop.stop_requested()) return reach;
      if (is_empty(intersection(p.body.box, q.body.box))) continue;
      if (!p.has_inside() && !q.has_inside()) {
        const double crossing = surface_reach(p.body, q.body, goal.stop);
        reach.through = reach.through || crossing == kInfinity;
        reach.crossing = std::max(reach.crossing, crossing);
        continue;
      }
      const Interval triangles_p = reach_of_triangles(p, q, goal), triangles_q = reach_of_triangles(q, p, goal);
      reach.triangles_a_in_b = larger(reach.triangles_a_in_b, triangles_p);
      reach.triangles_b_in_a = larger(reach.triangles_b_in_a, triangles_q);
      const Interval p_in_q = larger(triangles_p, reach_of_material(p, q, triangles_p.lo));
      const Interval q_in_p = larger(triangles_q, reach_of_material(q, p, triangles_q.lo));
      reach.a_in_b = larger(reach.a_in_b, p_in_q), reach.b_in_a = larger(reach.b_in_a, q_in_p);
      reach.through = reach.through || go_through(p, q, p_in_q, q_in_p);
    }
  }
  return reach;
}

}  // namespace impinge::clash
