// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/verdict.hpp"

#include <algorithm>

#include "clash/depth.hpp"
#include "clash/surface_reach.hpp"
#include "measure/nearest.hpp"

namespace impinge::clash {
namespace {

/// Whether one part lies in another, up to a length.
class Containment {
 public:
  Containment(const PlacedPart& inner, const PlacedPart& outer, double length, const std::stop_token& stop)
      : inner_(inner), outer_(outer), length_(length), stop_(stop) {}

  /// No point of the inner part's triangles is outside by more than the length, none of its inner points whose radius
  /// is more, and the outer part has no bounds within it.
  [[nodiscard]] bool holds() const {
    const Box &inner = inner_.whole.box, &outer = outer_.whole.box;
    const double out = std::max(max_component(outer.lo - inner.lo), max_component(inner.hi - outer.hi));
    return out <= length_ && hold_samples() && !sticks_out() && !is_bounded_within();
  }

 private:
  [[nodiscard]] bool is_out(const Vec3& point) const {
    return !outer_.holds(point) && !measure::nearest_point(outer_.whole.placed, point, length_, length_, stop_);
  }

  /// One vertex is enough to say no, and most pairs have one.
  [[nodiscard]] bool hold_samples() const {
    constexpr std::size_t kTried = 32;
    const std::size_t stride = inner_.whole.world.size() / kTried + 1;
    for (std::size_t v = 0; v < inner_.whole.world.size(); v += stride)
      if (is_out(inner_.whole.world[v])) return false;
    for (const PlacedPiece& piece : inner_.pieces)
      for (const solid::InnerPoint& point : piece.inner_points)
        if (point.radius > length_ && is_out(point.point)) return false;
    return true;
  }

  [[nodiscard]] DepthGoal goal() const {
    return {.precision = kInfinity, .levels = {length_}, .enough = length_, .stop = stop_};
  }

  [[nodiscard]] bool sticks_out() const {
    const Winding outside{[&](const Vec3& point) { return 1 - outer_.winding(point); }, outer_.is_closed(),
                          [&](const Vec3& point, double within) { return outer_.to_open_edge(point, within); }};
    const auto touching = touching_pairs(inner_.whole, outer_.whole, stop_);
    return depth_in({inner_.whole, outer_.whole, outside, touching}, goal()).lo > length_;
  }

  /// Whether a triangle of the outer part is deep in the inner one. It does not count where the outer part's material
  /// is on both sides, as where its shells pass through each other: then the deepest point says nothing, and some of
  /// all triangles are tried.
  [[nodiscard]] bool is_bounded_within() const {
    const Winding within{[&](const Vec3& point) { return inner_.winding(point); }, inner_.is_closed(),
                         [&](const Vec3& point, double near) { return inner_.to_open_edge(point, near); }};
    const auto touching = touching_pairs(outer_.whole, inner_.whole, stop_);
    const Depth found = depth_in({outer_.whole, inner_.whole, within, touching}, goal());
    if (!(found.lo > length_)) return false;
    if (is_bound(found.deepest)) return true;
    constexpr int kRows = 4;
    for (std::uint32_t t = 0; t < outer_.whole.size() && !stop_.stop_requested(); ++t) {
      const Triangle triangle = outer_.whole.triangle(t);
      if (!overlap(box_of(triangle), inner_.whole.box)) continue;
      for (int i = 0; i < kRows; ++i) {
        for (int j = 0; i + j < kRows; ++j) {
          const double u = (i + 1.0 / 3) / kRows, v = (j + 1.0 / 3) / kRows;
          const Vec3 point = triangle[0] + u * (triangle[1] - triangle[0]) + v * (triangle[2] - triangle[0]);
          if (inner_.holds(point) && !measure::nearest_point(inner_.whole.placed, point, length_, length_) &&
              is_bound(point))
            return true;
        }
      }
    }
    return false;
  }

  /// Whether the outer part's material ends at a point of its triangles.
  [[nodiscard]] bool is_bound(const Vec3& point) const {
    const auto nearest = measure::nearest_point(outer_.whole.placed, point, kInfinity);
    if (!nearest) return true;
    const Triangle t = outer_.whole.triangle(nearest->triangle);
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    const double size = norm(normal);
    if (!(size > 0)) return true;
    const Vec3 off = (length_ / 2 / size) * normal;
    return !outer_.holds(point + off) || !outer_.holds(point - off);
  }

  const PlacedPart &inner_, &outer_;
  double length_;
  const std::stop_token& stop_;
};

/// The name of a pair that fails.
Judgement name_of_failure(double tolerance, const PlacedPart& a, const PlacedPart& b, const std::stop_token& stop) {
  const bool both = a.has_inside() && b.has_inside(), one = a.has_inside() || b.has_inside();
  if (are_same(a.whole, b.whole, !one, stop)) return {Verdict::duplicate};
  if (!one) return {Verdict::crossing};
  const double radius = both ? std::min(a.radius(), b.radius()) : std::max(a.radius(), b.radius());
  const Box box{min(a.whole.box.lo, b.whole.box.lo), max(a.whole.box.hi, b.whole.box.hi)};
  const double s = std::max(std::min(tolerance, radius / 2), 0x1p-20 * norm(box.hi - box.lo));
  const bool a_in_b = b.has_inside() && Containment(a, b, s, stop).holds();
  const bool b_in_a = a.has_inside() && Containment(b, a, s, stop).holds();
  if (a_in_b && b_in_a) return {Verdict::duplicate};
  if (a_in_b || b_in_a) return {Verdict::inside, a_in_b ? 0 : 1};
  return {both ? Verdict::penetrating : Verdict::crossing};
}

}  // namespace

Judgement verdict_at(double tolerance, const PlacedPart& a, const PlacedPart& b, const PairReach& reach,
                     bool share_point, const std::stop_token& stop) {
  if (tolerance < reach.fails_below()) return name_of_failure(tolerance, a, b, stop);
  Judgement result;
  const auto are_near = [&] {
    return measure::nearest_pair(a.whole.placed, b.whole.placed, tolerance, tolerance, {.stop = stop}).has_value();
  };
  if (share_point || reach.fails_below() > 0 || are_near()) result.verdict = Verdict::touching;
  // No search tells depths apart that differ by less.
  const double rounding = 0x1p-42 * std::max(largest_coordinate(a.whole.box), largest_coordinate(b.whole.box));
  result.undecided = tolerance + rounding < std::max(reach.a_in_b.hi, reach.b_in_a.hi);
  return result;
}

// Bits are only ever added, and a bit rules out each of the verdicts before `penetrating` for good.
bool is_settled(const solid::Cells& cells) { return exact_verdict(cells, false).verdict == Verdict::penetrating; }

Judgement exact_verdict(const solid::Cells& c, bool share_point) {
  using solid::kInside, solid::kOtherSide, solid::kOutside, solid::kSameSide;
  // An open 2-cell of one boundary is in the other's interior, or is shared with both interiors on one side.
  if (((c.a | c.b) & (kInside | kSameSide)) == 0) return {share_point ? Verdict::touching : Verdict::apart};
  if (((c.a | c.b) & (kInside | kOutside | kOtherSide)) == 0) return {Verdict::duplicate};
  // No cell of the inner boundary is outside of the outer part, and no cell of the outer one inside of the inner part.
  const auto may_lie_inside = [](std::uint8_t inner, std::uint8_t outer) {
    return (inner & (kOutside | kOtherSide)) == 0 && (outer & (kInside | kOtherSide)) == 0;
  };
  if (may_lie_inside(c.a, c.b)) return {Verdict::inside, 0};
  if (may_lie_inside(c.b, c.a)) return {Verdict::inside, 1};
  return {Verdict::penetrating};
}

}  // namespace impinge::clash
