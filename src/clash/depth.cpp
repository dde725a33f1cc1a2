// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/depth.hpp"

#include <algorithm>
#include <limits>
#include <queue>

#include "clash/local_frame.hpp"
#include "measure/nearest.hpp"
#include "measure/triangle_distance.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// A part of a triangle, and the most that any of its points is deep.
struct Piece {
  Triangle triangle;
  double most;
  friend bool operator<(const Piece& p, const Piece& q) { return p.most < q.most; }
};

/// Branch and bound: the piece that may be deepest is halved until it is known well enough.
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
      if (overlap(box_of(inner_.triangle(t)), common)) look_at(inner_.triangle(t));
    while (!open_.empty() && !is_good(open_.top().most) && !goal_.stop.stop_requested()) {
      if (points_ > goal_.most_points + inner_.size()) return {least_, std::max(least_, open_.top().most)};
      const Piece piece = open_.top();
      open_.pop();
      halve(piece.triangle);
    }
    return {least_, std::max(least_, std::max(settled_, open_.empty() ? 0 : open_.top().most))};
  }

 private:
  [[nodiscard]] bool is_good(double most) const { return most * (1 - goal_.precision) <= least_ || most <= floor_; }

  // Depth is 0 outside, and no two points' depths differ by more than their distance: with the centre c in the depth d,
  // no point of a piece of radius r is deeper than d + r, and with c farther than r outside none is inside at all. Nor
  // is any farther from the boundary than the farthest vertex is from any one triangle of it, which is convex.
  void look_at(const Triangle& piece) {
    ++points_;
    const Vec3 center = (1.0 / 3) * piece[0] + (1.0 / 3) * piece[1] + (1.0 / 3) * piece[2];
    double radius = 0;
    for (const Vec3& vertex : piece) radius = std::max(radius, norm(vertex - center));
    radius = radius * (1 + 0x1p-40) + floor_;
    const auto nearest = measure::nearest_point(outer_.placed, center, kFar);
    if (!nearest) return;
    const bool is_inside = solid::winding_number(outer_.placed, center).value_or(0) != 0;
    if (!is_inside && nearest->distance - nearest->error > radius) return;
    if (is_inside) least_ = std::max(least_, nearest->distance - nearest->error - floor_);
    double farthest = 0;
    const Triangle boundary = outer_.triangle(nearest->triangle);
    for (const Vec3& vertex : piece) {
      const auto found = measure::point_distance(vertex, boundary, kFar);
      farthest = std::max(farthest, found.distance + found.margin);
    }
    const double by_center = (is_inside ? nearest->distance : -nearest->distance) + nearest->error + radius;
    const double most = std::min(by_center, farthest * (1 + 0x1p-40) + floor_);
    if (is_good(most)) {
      settled_ = std::max(settled_, most);
    } else {
      open_.push({piece, most});
    }
  }

  void halve(const Triangle& piece) {
    std::size_t longest = 0;
    double length = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double edge = norm(piece[(i + 1) % 3] - piece[i]);
      if (edge > length) length = edge, longest = i;
    }
    const Vec3 &from = piece[longest], &to = piece[(longest + 1) % 3], &apex = piece[(longest + 2) % 3];
    const Vec3 middle = 0.5 * from + 0.5 * to;
    look_at({from, middle, apex}), look_at({middle, to, apex});
  }

  const solid::Body &inner_, &outer_;
  const DepthGoal& goal_;
  double floor_;        ///< what rounding leaves of a length
  double least_ = 0;    ///< some point is so deep
  double settled_ = 0;  ///< none of the pieces that were laid aside is deeper
  std::priority_queue<Piece> open_;
  std::uint64_t points_ = 0;
};

}  // namespace

Interval depth_in(const solid::Body& inner, const solid::Body& outer, const DepthGoal& goal) {
  return Search(inner, outer, goal).run();
}

}  // namespace impinge::clash
