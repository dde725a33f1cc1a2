// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <queue>
#include <vector>

#include "clash/cover.hpp"
#include "clash/polygon.hpp"
#include "core/local_frame.hpp"
#include "measure/nearest.hpp"
#include "measure/triangle_distance.hpp"
#include "solid/cells.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

/// A piece of a triangle with an upper bound of the depth of its points.
struct TrianglePiece {
  Polygon polygon;
  double drift = 0;                 ///< how far the roundings of its cuts may have moved its points
  std::vector<std::uint32_t> near;  ///< triangles of the other body that may be near; if none, the piece is on one side
  std::uint32_t whole = 0;          ///< the triangle from which it was cut
  bool is_inside = false;           ///< whether the middle is inside; not computed where it does not matter
  bool is_settled = false;          ///< all of the piece is inside
  double most = 0, radius = 0;  ///< the upper bound of the depth; the distance of the farthest vertex from the middle
  std::uint32_t nearest = 0;    ///< the other body's triangle that is nearest to the middle
  friend bool operator<(const TrianglePiece& p, const TrianglePiece& q) { return p.most < q.most; }
};

Vec3 unit(const Vec3& v) {
  const double length = norm(v);
  return length > 0 ? (1 / length) * v : Vec3{0, 0, 0};
}

double longest_edge(const Triangle& t) { return std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])}); }

/// Whether a plane normal to `n` separates the polygon from the triangle by more than `gap`.
bool are_apart_along(const Vec3& n, const Polygon& polygon, const Triangle& t, double gap) {
  const double most = std::max({0.0, dot(n, t[1] - t[0]), dot(n, t[2] - t[0])}) + gap * norm(n);
  return std::all_of(polygon.begin(), polygon.end(), [&](const Vec3& v) { return dot(n, v - t[0]) > most; });
}

/// Whether the polygon may be within `gap` of the triangle. The triangle's own plane or sides separate most pairs.
bool are_near(const Polygon& polygon, const Triangle& t, double gap) {
  const Vec3 up = cross(unit(t[1] - t[0]), unit(t[2] - t[0]));
  if (are_apart_along(up, polygon, t, gap) || are_apart_along(-1.0 * up, polygon, t, gap)) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (are_apart_along(cross(unit(t[(i + 1) % 3] - t[i]), up), polygon, t, gap)) return false;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    if (!(measure::triangle_distance({polygon[0], polygon[i - 1], polygon[i]}, t, gap).lower > gap)) return true;
  return false;
}

/// Offsets the sides of a triangle by `margin`, cutting off sharp corners as make_slab does, and returns the one that
/// cuts the polygon and over which the polygon reaches farthest. `with_top`: the offset faces count too.
std::optional<HalfSpace> farthest_crossed(const Polygon& polygon, const Triangle& t, double margin, bool with_top) {
  std::optional<HalfSpace> best;
  double most_over = 1.125 * margin;
  const auto offer = [&](const Vec3& point, const Vec3& outward) {
    double least = kInfinity, most = -kInfinity;
    for (const Vec3& vertex : polygon) {
      const double over = dot(outward, vertex - point);
      least = std::min(least, over), most = std::max(most, over);
    }
    if (!(least < 0.9375 * margin && most > most_over)) return;
    most_over = most, best = HalfSpace{outward, dot(outward, point) + margin};
  };
  const std::array<Vec3, 3> along{unit(t[1] - t[0]), unit(t[2] - t[1]), unit(t[0] - t[2])};
  const Vec3 up = unit(cross(along[0], along[1]));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &in = along[(i + 2) % 3], &out = along[i];
    offer(t[i], unit(cross(out, up)));
    if (dot(in, out) < -0.87) offer(t[i], unit(in - out));
  }
  if (with_top) offer(t[0], up), offer(t[0], -1.0 * up);
  return best;
}

/// Branch and bound: the piece with the greatest upper bound is cut in two until the interval is narrow enough.
///
/// Let W be the largest coordinate and w = 2^-45 W. Pieces that were cut so often that their points may have moved by
/// more than w are cut no further. Triangles of the other body that are farther than 5 w from a triangle, or than 3.5 w
/// from a piece of it, are more than 2.5 w from the true piece, whose points are within w of the computed ones: neither
/// they nor the way to its computed middle meet them. Where that goes for all of them, the piece is on one side.
///
/// A piece that comes near a triangle is cut along the sides of the triangle offset by 4 w: the part within is some w
/// deep at most, which counts as 0, and the rest is clear of that triangle. So pieces that lie outside but touch,
/// beside a flush face or on top of it, are decided after a few cuts. Halving would go on down to that depth all along
/// the face.
class Search {
 public:
  Search(const solid::Body& inner, const solid::Body& outer, const Winding& winding, const DepthGoal& goal)
      : inner_(inner),
        outer_(outer),
        winding_(winding),
        goal_(goal),
        largest_(std::max(largest_coordinate(inner.box), largest_coordinate(outer.box))) {}

  Interval run() {
    const Box common = intersection(inner_.box, outer_.box);
    if (is_empty(common)) return {};
    std::vector<TrianglePair> near;
    const auto take = [&](const TrianglePair& pair) { return near.push_back(pair), true; };
    measure::near_pairs(inner_.placed, outer_.placed, 5 * most_drift_, take, goal_.stop);
    std::sort(near.begin(), near.end(), [](const auto& p, const auto& q) { return p.a < q.a; });
    auto pair = near.begin();
    for (std::uint32_t t = 0; t < inner_.size() && !goal_.stop.stop_requested(); ++t) {
      TrianglePiece piece{Polygon(inner_.triangle(t)), 0, {}, t};
      for (; pair != near.end() && pair->a == t; ++pair) piece.near.push_back(pair->b);
      if (overlap(box_of(inner_.triangle(t)), common)) look_at(std::move(piece));
    }
    const std::uint64_t last = effort_ + goal_.most_points + 4 * near.size();
    while (!open_.empty() && !is_good(open_.top().most) && effort_ < last && !goal_.stop.stop_requested()) {
      TrianglePiece piece = open_.top();
      open_.pop();
      divide(piece);
    }
    return {least_, std::max({least_, laid_aside_, open_.empty() ? 0 : open_.top().most})};
  }

 private:
  [[nodiscard]] bool is_good(double most) const { return most <= (1 + goal_.precision) * least_ || most <= nothing_; }

  // Depth is 0 outside, and the depths of two points differ by no more than their distance: if the middle of a piece of
  // radius r has the depth d, no point of it is deeper than d + r, and if the middle is outside and farther than r from
  // the boundary, no point is inside. Nor is any point farther from the boundary than the farthest vertex of the piece
  // is from any one triangle, since distance from a convex set is convex.
  void look_at(TrianglePiece piece) {
    ++effort_;
    const Vec3 middle = piece.polygon.middle();
    if (!piece.near.empty() && lies_flat(piece)) {
      laid_aside_ = std::max(laid_aside_, 2.5 * most_drift_ + piece.drift + floor_);
      return;
    }
    if (piece.near.empty() && !settle(piece)) return;
    const auto nearest = measure::nearest_point(outer_.placed, middle, kInfinity);
    if (!nearest) return;
    const double slack = piece.drift + floor_;
    piece.nearest = nearest->triangle;
    piece.most = farthest_from(outer_.triangle(nearest->triangle), piece.polygon) + slack;
    for (const Vec3& vertex : piece.polygon) piece.radius = std::max(piece.radius, norm(vertex - middle));
    const double least = nearest->distance - nearest->error - slack;
    if (!is_good(piece.most) || least > least_) {
      if (!piece.is_settled) piece.is_inside = is_inside(middle);
      const double reach = piece.radius * (1 + 0x1p-40) + nearest->error + slack;
      if (!piece.is_inside && nearest->distance > reach) return;
      if (piece.is_inside) least_ = std::max(least_, least);
      piece.most = std::min(piece.most, (piece.is_inside ? 1 : -1) * nearest->distance + reach);
    }
    if (is_good(piece.most) || piece.drift > most_drift_) {
      laid_aside_ = std::max(laid_aside_, piece.most);
    } else {
      open_.push(std::move(piece));
    }
  }

  [[nodiscard]] bool is_inside(const Vec3& point) const { return winding_.at(point) > 0.5; }

  /// Finds out whether a piece that touches no triangle is inside as a whole; returns false if it is outside as a
  /// whole.
  bool settle(TrianglePiece& piece) const {
    if (piece.is_settled) return true;
    const double at_middle = winding_.at(piece.polygon.middle());
    double least = at_middle, most = at_middle;
    if (!winding_.closed) {
      for (const Vec3& vertex : piece.polygon) {
        if (least < 0.75 && most > 0.25) break;
        const double at_vertex = winding_.at(vertex);
        least = std::min(least, at_vertex), most = std::max(most, at_vertex);
      }
    }
    piece.is_settled = piece.is_inside = least > 0.75;
    return most > 0.25;
  }

  bool lies_flat(const TrianglePiece& piece) {
    effort_ += piece.near.size() / kEdgesAPoint;
    return piece.drift <= most_drift_ &&
           is_covered({inner_.triangle(piece.whole), piece.polygon, outer_, piece.near, most_drift_});
  }

  static double farthest_from(const Triangle& triangle, const Polygon& polygon) {
    double farthest = 0;
    for (const Vec3& vertex : polygon) {
      const auto found = measure::point_distance(vertex, triangle, kInfinity);
      farthest = std::max(farthest, found.distance + found.margin);
    }
    return farthest;
  }

  void divide(TrianglePiece& piece) {
    while (!piece.near.empty() && !are_near(piece.polygon, outer_.triangle(piece.near.back()), near_))
      piece.near.pop_back();
    if (piece.near.empty()) {
      if (winding_.closed) piece.is_settled = piece.is_inside;  // the middle's side is that of all
      if (!piece.is_settled && (winding_.closed || !settle(piece))) return;
    }
    // A new vertex is rounded once, after a multiple of a difference of two that are no farther apart than 2 radii.
    const double drift = piece.drift + 0x1p-53 * (1.75 * largest_ + 4 * piece.radius);
    const Cut parts = part(piece);
    for (const Polygon* one : {&parts.within, &parts.beyond}) {
      if (one->size() == 0) continue;
      effort_ += piece.near.size() / kBoxesAPoint;
      look_at({*one, drift, near_among(piece.near, *one), piece.whole, piece.is_settled, piece.is_settled});
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> near_among(const std::vector<std::uint32_t>& all,
                                                      const Polygon& polygon) const {
    Box box{polygon[0], polygon[0]};
    for (const Vec3& point : polygon) box = {min(box.lo, point), max(box.hi, point)};
    const Vec3 reach{near_, near_, near_};
    box = {box.lo - reach, box.hi + reach};
    std::vector<std::uint32_t> near;
    std::copy_if(all.begin(), all.end(), std::back_inserter(near),
                 [&](std::uint32_t t) { return overlap(box_of(outer_.triangle(t)), box); });
    return near;
  }

  /// Cuts a piece along the border of the nearest triangle if it reaches beyond that (over one triangle the distance is
  /// greatest at a vertex of the piece), or out of a triangle to which it is near; otherwise, and where these triangles
  /// are small beside the piece, in halves.
  [[nodiscard]] Cut part(const TrianglePiece& piece) const {
    if (piece.polygon.is_full()) return halve(piece.polygon);
    const bool is_clear = piece.near.empty();
    for (const std::uint32_t t : {piece.nearest, is_clear ? piece.nearest : piece.near.back()}) {
      const Triangle triangle = outer_.triangle(t);
      if (piece.radius > 2 * longest_edge(triangle)) continue;
      if (const auto side = farthest_crossed(piece.polygon, triangle, beside_, !is_clear))
        return cut(piece.polygon, *side);
    }
    return halve(piece.polygon);
  }

  static constexpr std::size_t kBoxesAPoint = 256;  ///< so many boxes take as much time as one point
  static constexpr std::size_t kEdgesAPoint = 16;   ///< the edges of so many triangles take as much time as one point

  const solid::Body &inner_, &outer_;
  const Winding& winding_;
  const DepthGoal& goal_;
  double largest_;
  double most_drift_ = 0x1p-45 * largest_;  ///< w above
  double near_ = 3.5 * most_drift_, beside_ = 4 * most_drift_;
  double nothing_ = std::max(8 * most_drift_, goal_.nothing);  ///< a depth up to this counts as 0
  double floor_ = 0x1p-48 * largest_;                          ///< the rounding error of a length
  double least_ = 0;                                           ///< some point is at least so deep
  double laid_aside_ = 0;                                      ///< no piece that was laid aside is deeper
  std::priority_queue<TrianglePiece> open_;
  std::uint64_t effort_ = 0;  ///< in points examined
};

}  // namespace

Interval depth_in(const solid::Body& inner, const solid::Body& outer, const Winding& winding, const DepthGoal& goal) {
  return Search(inner, outer, winding, goal).run();
}

Interval depth_in(const solid::Body& inner, const solid::Body& outer, const DepthGoal& goal) {
  const Winding winding{[&](const Vec3& p) { return std::abs(solid::winding_number(outer.placed, p).value_or(0)); }};
  return depth_in(inner, outer, winding, goal);
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
