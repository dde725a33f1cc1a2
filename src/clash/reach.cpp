// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/reach.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "clash/depth.hpp"
#include "clash/surface_reach.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

Interval larger(const Interval& p, const Interval& q) { return {std::max(p.lo, q.lo), std::max(p.hi, q.hi)}; }

/// The largest radius of the outer piece's inner points that the inner piece's material holds, if it is above `known`:
/// pieces may coincide, and then no triangle lies inside.
double reach_of_material(const PlacedPiece& inner, const PlacedPiece& outer, double known) {
  double largest = 0;
  if (inner.has_inside())
    for (const solid::InnerPoint& point : outer.inner_points)
      if (point.radius > std::max(known, largest) && overlap({point.point, point.point}, inner.body.box) &&
          inner.holds(point.point))
        largest = point.radius;
  return largest;
}

/// Two pieces that may meet, at least one of which has an inside.
class PiecePair {
 public:
  PiecePair(const PlacedPiece& p, const PlacedPiece& q, const ReachGoal& goal)
      : p_(p), q_(q), goal_(goal), touching_(touching_pairs(p.body, q.body, goal.stop)) {}

  /// `known` is a depth of other pieces of the two parts; above `most` none needs to be known.
  void measure(double known, double most) {
    p_in_q = reach(p_, q_, known, goal_.levels);
    q_in_p = p_in_q.lo > most ? Interval{0, kInfinity} : reach(q_, p_, std::max(known, p_in_q.lo), goal_.levels);
  }

  /// No tolerance excuses what reaches in by more than half of the other's radius, both ways. The lower ends decide.
  bool go_through() {
    const auto may = [](const Interval& depth, const PlacedPiece& outer) {
      return outer.has_inside() && depth.hi > outer.radius / 2;
    };
    const bool p_may = may(p_in_q, q_), q_may = may(q_in_p, p_);
    if (p_.has_inside() && q_.has_inside() ? !p_may || !q_may : !p_may && !q_may) return false;
    const auto is_deep = [&](const PlacedPiece& inner, const PlacedPiece& outer, Interval& depth) {
      if (depth.lo > outer.radius / 2) return true;
      const Interval found = reach(inner, outer, 0, {outer.radius / 2});
      depth = {std::max(depth.lo, found.lo), std::min(depth.hi, found.hi)};
      return depth.lo > outer.radius / 2;
    };
    return (!q_.has_inside() || is_deep(p_, q_, p_in_q)) && (!p_.has_inside() || is_deep(q_, p_, q_in_p));
  }

  Interval p_in_q, q_in_p;

 private:
  /// How deep the inner piece reaches into the outer one. Depths up to `known`, or up to the least level, need not be
  /// told apart.
  Interval reach(const PlacedPiece& inner, const PlacedPiece& outer, double known, std::vector<double> levels) {
    if (!outer.has_inside()) return {};
    const Winding winding{[&](const Vec3& point) { return outer.winding(point); }, outer.part_class == PartClass::solid,
                          [&](const Vec3& point, double within) { return outer.to_open_edge(point, within); }};
    const double material = reach_of_material(inner, outer, known);
    DepthGoal depth{.precision = goal_.precision, .known = std::max(known, material), .stop = goal_.stop};
    // At those the parts fail already.
    std::erase_if(levels, [&](double level) { return level < depth.known; });
    if (!levels.empty()) depth.enough = *std::min_element(levels.begin(), levels.end());
    depth.levels = std::move(levels);
    if (!winding.closed) {
      // Cracks are as wide as what single precision leaves, or wider; and winding numbers cost more beside them.
      depth.nothing = 0x1p-20 * norm(outer.body.box.hi - outer.body.box.lo);
      depth.most_points /= 8;
    }
    if (&inner != first_inner_) {
      for (TrianglePair& pair : touching_) std::swap(pair.a, pair.b);
      first_inner_ = &inner;
    }
    const Interval triangles = depth_in({inner.body, outer.body, winding, touching_}, depth);
    // Of inner points up to `known` nobody asked.
    const double unasked = inner.has_inside() ? std::min(known, outer.radius) : 0;
    return {std::max(triangles.lo, material), std::max({triangles.hi, material, unasked})};
  }

  const PlacedPiece &p_, &q_;
  const ReachGoal& goal_;
  std::vector<TrianglePair> touching_;  ///< triangles of `first_inner_` with such of the other
  const PlacedPiece* first_inner_ = &p_;
};

}  // namespace

Vec3 PlacedPiece::local(const Vec3& point) const {
  const auto& t = body.placed.pose.t;
  return frame.to_local(to_mesh * (point - Vec3{t[0], t[1], t[2]}));
}

double PlacedPiece::winding(const Vec3& point) const {
  if (part_class == PartClass::solid) return std::abs(solid::winding_number(body.placed, point).value_or(0));
  return tree != nullptr ? std::abs(tree->winding_number(local(point))) : 0;
}

double PlacedPiece::to_open_edge(const Vec3& point, double within) const {
  const auto nearest = open_edges != nullptr ? open_edges->nearest(local(point), within * frame.unit) : std::nullopt;
  return nearest ? nearest->distance / frame.unit : kInfinity;
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

double PlacedPart::to_open_edge(const Vec3& point, double within) const {
  double least = kInfinity;
  for (const PlacedPiece& piece : pieces) least = std::min(least, piece.to_open_edge(point, within));
  return least;
}

bool PlacedPart::is_closed() const {
  return std::all_of(pieces.begin(), pieces.end(),
                     [](const PlacedPiece& piece) { return piece.part_class == PartClass::solid; });
}

double PairReach::fails_below() const { return through ? kInfinity : std::max({a_in_b.lo, b_in_a.lo, crossing}); }

PairReach reach_between(const PlacedPart& a, const PlacedPart& b, const ReachGoal& goal) {
  PairReach reach;
  const bool decides_alone = std::isinf(goal.precision) && !goal.levels.empty();
  const double most = decides_alone ? *std::max_element(goal.levels.begin(), goal.levels.end()) : kInfinity;
  for (const PlacedPiece& p : a.pieces) {
    for (const PlacedPiece& q : b.pieces) {
      if (goal.stop.stop_requested()) return reach;
      if (reach.fails_below() > most) {
        reach.a_in_b.hi = reach.b_in_a.hi = kInfinity;
        return reach;
      }
      if (is_empty(intersection(p.body.box, q.body.box))) continue;
      if (!p.has_inside() && !q.has_inside()) {
        const double crossing = surface_reach(p.body, q.body, goal.stop);
        reach.through = reach.through || crossing == kInfinity;
        reach.crossing = std::max(reach.crossing, crossing);
        continue;
      }
      PiecePair pair(p, q, goal);
      pair.measure(std::max(reach.a_in_b.lo, reach.b_in_a.lo), most);
      if (!reach.through && !(std::max(pair.p_in_q.lo, pair.q_in_p.lo) > most)) reach.through = pair.go_through();
      reach.a_in_b = larger(reach.a_in_b, pair.p_in_q), reach.b_in_a = larger(reach.b_in_a, pair.q_in_p);
    }
  }
  return reach;
}

}  // namespace impinge::clash
