// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/reach_verdict.hpp"

#include <algorithm>

#include "clash/depth.hpp"
#include "measure/nearest.hpp"

namespace impinge::clash {
namespace {

/// Whether no point of the inner part's triangles is outside of the outer part by more than `s`, and none of its inner
/// points whose radius is more. (That nothing of the outer part reaches into it is known by then.)
bool lies_in(const PlacedPart& inner, const PlacedPart& outer, double s, const ReachGoal& goal) {
  const auto is_out = [&](const Vec3& point) {
    return !outer.holds(point) && !measure::nearest_point(outer.whole.placed, point, s, s, goal.stop);
  };
  for (const PlacedPiece& piece : inner.pieces)
    for (const solid::InnerPoint& point : piece.inner_points)
      if (point.radius > s && !outer.holds(point.point)) return false;
  // One vertex is enough to say no, and most pairs have one.
  constexpr std::size_t kTried = 32;
  const std::size_t stride = inner.whole.world.size() / kTried + 1;
  for (std::size_t v = 0; v < inner.whole.world.size(); v += stride)
    if (is_out(inner.whole.world[v])) return false;
  const bool closed = std::all_of(outer.pieces.begin(), outer.pieces.end(),
                                  [](const PlacedPiece& piece) { return piece.part_class == PartClass::solid; });
  const Winding outside{[&](const Vec3& point) { return std::max(0.0, 1 - outer.winding(point)); }, closed};
  return depth_in(inner.whole, outer.whole, outside, {.precision = goal.precision, .stop = goal.stop}).lo <= s;
}

/// The name of a pair that fails.
ReachVerdict name_of_failure(double tolerance, const PlacedPart& a, const PlacedPart& b, const PairReach& reach,
                             const ReachGoal& goal) {
  const bool both = a.has_inside() && b.has_inside(), one = a.has_inside() || b.has_inside();
  if (!one) return {reach.through ? Verdict::duplicate : Verdict::crossing};
  const double radius = both ? std::min(a.radius(), b.radius()) : std::max(a.radius(), b.radius());
  const Box box{min(a.whole.box.lo, b.whole.box.lo), max(a.whole.box.hi, b.whole.box.hi)};
  const double s = std::max(std::min(tolerance, radius / 2), 0x1p-20 * norm(box.hi - box.lo));
  const bool a_in_b = b.has_inside() && reach.triangles_b_in_a.lo <= s && lies_in(a, b, s, goal);
  const bool b_in_a = a.has_inside() && reach.triangles_a_in_b.lo <= s && lies_in(b, a, s, goal);
  if (a_in_b && b_in_a) return {Verdict::duplicate};
  if (a_in_b || b_in_a) return {Verdict::inside, a_in_b ? 0 : 1};
  return {both ? Verdict::penetrating : Verdict::crossing};
}

}  // namespace

ReachVerdict verdict_at(double tolerance, const PlacedPart& a, const PlacedPart& b, const PairReach& reach,
                        const ReachGoal& goal) {
  if (tolerance < reach.fails_below()) return name_of_failure(tolerance, a, b, reach, goal);
  ReachVerdict result;
  const auto near = measure::nearest_pair(a.whole.placed, b.whole.placed, tolerance, tolerance, {.stop = goal.stop});
  if (near || reach.fails_below() > 0) result.verdict = Verdict::touching;
  result.undecided = tolerance < std::max(reach.a_in_b.hi, reach.b_in_a.hi);
  return result;
}

}  // namespace impinge::clash
