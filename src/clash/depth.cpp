// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/depth.hpp"

#include <algorithm>
#include <limits>
#include <queue>

#include "clash/local_frame.hpp"
#include "clash/polygon.hpp"
#include "measure/nearest.hpp"
#include "measure/triangle_distance.hpp"
#include "solid/cells.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// A part of a triangle, and the most that any of its points is deep.
struct Piece {
  Polygon polygon;
  double most;
  std::uint32_t nearest;  ///< the other body's triangle that is nearest to the middle
  friend bool operator<(const Piece& p, const Piece& q) { return p.most < q.most; }
};

/// Branch and bound: the piece that may be deepest is cut in two until it is known well enough.
class Search {
 public:
  Search(const solid::Body& inner, const solid::Body& outer, const DepthGoal& goal)
      : inner_(inner),
        outer_(outer),
        goal_(goal),
        floor_(0x1p-48 * std::max(largest_coordinate(inner.box), largest_coordinate(outer.box))) {}

  Interval run() {
    const Box common = intersection(inner_.box, outer_.box);
    if (is_empty(common)) return {};
    for (std::uint32_t t = 0; t < inner_.size() && !goal_.stop.stop_requested(); ++t)
      if (overlap(box_of(inner_.triangle(t)), common)) look_at(Polygon(inner_.triangle(t)));
    const std::uint64_t last = points_ + goal_.most_points;
    while (!open_.empty() && !is_good(open_.top().most) && points_ < last && !goal_.stop.stop_requested()) {
      const Piece piece = open_.top();
      open_.pop();
      const Cut parts = part(piece);
      for (const Polygon* one : {&parts.within, &parts.beyond})
        if (one->size() > 0) look_at(*one);
    }
    return {least_, std::max({least_, laid_aside_, open_.empty() ? 0 : open_.top().most})};
  }

 private:
  [[nodiscard]] bool is_good(double most) const { return most * (1 - goal_.precision) <= least_ || most <= floor_; }

  // Depth is 0 outside, and no two points' depths differ by more than their distance: with the middle in the depth d,
  // no point of a piece of radius r is deeper than d + r, and with it farther than r outside none is inside at all. Nor
  // is any farther from the boundary than the farthest vertex is from any one triangle of it, which is convex. What
  // rounding moves a piece's vertices by is below the floor.
  void look_at(const Polygon& polygon) {
    ++points_;
    const Vec3 middle = polygon.middle();
    double radius = 0;
    for (const Vec3& vertex : polygon) radius = std::max(radius, norm(vertex - middle));
    radius = radius * (1 + 0x1p-40) + floor_;
    const auto nearest = measure::nearest_point(outer_.placed, middle, kFar);
    if (!nearest) return;
    const bool is_inside = solid::winding_number(outer_.placed, middle).value_or(0) != 0;
    if (!is_inside && nearest->distance - nearest->error > radius) return;
    if (is_inside) least_ = std::max(least_, nearest->distance - nearest->error - floor_);
    double farthest = 0;
    const Triangle boundary = outer_.triangle(nearest->triangle);
    for (const Vec3& vertex : polygon) {
      const auto found = measure::point_distance(vertex, boundary, kFar);
      farthest = std::max(farthest, found.distance + found.margin);
    }
    const double by_middle = (is_inside ? nearest->distance : -nearest->distance) + nearest->error + radius;
    const double most = std::min(by_middle, farthest * (1 + 0x1p-40) + floor_);
    if (is_good(most)) {
      laid_aside_ = std::max(laid_aside_, most);
    } else {
      open_.push({polygon, most, nearest->triangle});
    }
  }

  /// Along the border of the triangle that is nearest, where the piece reaches over it: what lies over one triangle is
  /// as far from it as its vertices are, and flush faces come apart at once. Elsewhere in halves.
  [[nodiscard]] Cut part(const Piece& piece) const {
    const Triangle t = outer_.triangle(piece.nearest);
    const Vec3 first = unit(t[1] - t[0]), up = cross(first, unit(t[2] - t[0]));
    double most_over = 2 * floor_;
    HalfSpace border{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 outward = unit(cross(t[(i + 1) % 3] - t[i], up));
      double least = kFar, greatest = -kFar;
      for (const Vec3& vertex : piece.polygon) {
        const double over = dot(outward, vertex - t[i]);
        least = std::min(least, over), greatest = std::max(greatest, over);
      }
      if (least < -2 * floor_ && greatest > most_over) most_over = greatest, border = {outward, dot(outward, t[i])};
    }
    if (most_over > 2 * floor_ && !piece.polygon.is_full()) return cut(piece.polygon, border);
    return halve(piece.polygon);
  }

  static Vec3 unit(const Vec3& v) {
    const double length = norm(v);
    return length > 0 ? (1 / length) * v : Vec3{0, 0, 0};
  }

  const solid::Body &inner_, &outer_;
  const DepthGoal& goal_;
  double floor_;           ///< what rounding leaves of a length
  double least_ = 0;       ///< some point is so deep
  double laid_aside_ = 0;  ///< none of the pieces that were laid aside is deeper
  std::priority_queue<Piece> open_;
  std::uint64_t points_ = 0;
};

}  // namespace

Interval depth_in(const solid::Body& inner, const solid::Body& outer, const DepthGoal& goal) {
  return Search(inner, outer, goal).run();
}

OverlapDepth depths_of(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
                       const DepthGoal& goal) {
  const auto both = [&](const solid::Cells& c) {
    return (c.a & c.b & solid::kInside) != 0 || goal.stop.stop_requested();
  };
  const solid::Cells cells = solid::cells_of(a, b, contacts, both);
  OverlapDepth depth;
  if ((cells.a & solid::kInside) != 0) depth.a_in_b = depth_in(a.body, b.body, goal);
  if ((cells.b & solid::kInside) != 0) depth.b_in_a = depth_in(b.body, a.body, goal);
  return depth;
}

}  // namespace impinge::clash
