// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <queue>
#include <vector>

#include "clash/patch_sides.hpp"
#include "clash/polygon.hpp"
#include "core/local_frame.hpp"
#include "core/number.hpp"
#include "core/point_table.hpp"
#include "core/stopped.hpp"
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
  std::uint32_t nearest = 0;        ///< of the other body's triangles, to the middle
  bool is_settled = false;          ///< all of the piece is inside
  bool is_examined = false;         ///< it is known on which side the middle is
  bool is_inside = false;           ///< the middle is inside
  double most = 0, radius = 0;  ///< the upper bound of the depth; the distance of the farthest vertex from the middle
  double distance = 0, error = 0;  ///< of the middle from the other body's triangles
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

/// Offsets the sides of a triangle by `margin`, cutting off sharp corners, and returns the one that
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

/// What is known of the corner of a piece that touches no triangle.
struct PieceCorner {
  bool is_inside = false;
  double reach = 0;  ///< how far that goes on over triangles that meet no other
  std::optional<double> winding{};
};

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
  Search(const DepthSearch& search, const DepthGoal& goal)
      : inner_(search.inner),
        outer_(search.outer),
        winding_(search.winding),
        touching_(search.touching),
        goal_(goal),
        most_drift_(most_drift(inner_, outer_)) {}

  static double most_drift(const solid::Body& a, const solid::Body& b) {
    return 0x1p-45 * std::max(largest_coordinate(a.box), largest_coordinate(b.box));
  }

  Depth run() {
    const Box common = intersection(inner_.box, outer_.box);
    if (is_empty(common)) return {};
    std::vector<TrianglePair> near(touching_.begin(), touching_.end());
    std::sort(near.begin(), near.end(),
              until_stopped(goal_.stop, [](const auto& p, const auto& q) { return p.a < q.a; }));
    std::vector<std::uint32_t> candidates;
    for (const std::uint32_t t : inner_triangles_about(common)) {
      const Box box = intersection(box_of(inner_.triangle(t)), common);
      if (is_empty(box)) continue;
      if (const double most = most_by_box(box); most <= std::max(nothing_, goal_.enough))
        laid_aside_ = std::max(laid_aside_, most);
      else
        candidates.push_back(t);
    }
    PatchSides sides({inner_, outer_, winding_, touching_}, candidates);
    auto pair = near.begin();
    for (const std::uint32_t t : candidates) {
      if (goal_.stop.stop_requested()) break;
      const std::optional<bool> is_inside = sides.is_inside(t);
      if (is_inside == false) continue;
      TrianglePiece piece{Polygon(inner_.triangle(t)), 0, {}, last_nearest_, is_inside.has_value()};
      while (pair != near.end() && pair->a < t) ++pair;
      for (; pair != near.end() && pair->a == t; ++pair) piece.near.push_back(pair->b);
      look_at(std::move(piece));
    }
    const std::uint64_t last = effort_ + goal_.most_points + 4 * near.size();
    while (!is_done() && effort_ < last && !goal_.stop.stop_requested()) {
      TrianglePiece piece = pop();
      if (piece.is_examined) {
        divide(piece);
      } else if (examine(piece)) {
        keep(std::move(piece));
      }
    }
    return {{least_, std::max({least_, laid_aside_, open_.empty() ? 0 : open_.top().most})}, deepest_};
  }

 private:
  [[nodiscard]] bool is_done() const {
    if (open_.empty()) return true;
    const double most = open_.top().most;
    if (most <= std::max(goal_.enough, least_ + nothing_)) return true;
    const auto is_between = [&](double level) { return least_ <= level && level < most; };
    return !(most > (1 + goal_.precision) * std::max(least_, goal_.known)) &&
           std::none_of(goal_.levels.begin(), goal_.levels.end(), is_between);
  }

  /// The triangles of the inner body that may meet a box, in order: all, where the tree would not be faster.
  [[nodiscard]] std::vector<std::uint32_t> inner_triangles_about(const Box& box) const {
    constexpr std::size_t kMany = 4096;
    const double size = norm(box.hi - box.lo);
    std::vector<std::uint32_t> found;
    if (inner_.size() < kMany || 4 * size > norm(inner_.box.hi - inner_.box.lo)) {
      found.resize(inner_.size());
      std::iota(found.begin(), found.end(), 0U);
    } else {
      const double reach = size / 2 * (1 + 0x1p-20);
      measure::near_triangles(inner_.placed, 0.5 * box.lo + 0.5 * box.hi, reach,
                              [&](std::uint32_t t) { found.push_back(t); });
      std::sort(found.begin(), found.end());
    }
    return found;
  }

  /// The most depth in a box: from inside a closed body no way out of its box is free.
  [[nodiscard]] double most_by_box(const Box& box) const {
    if (!winding_.closed) return kInfinity;
    const Vec3 up = box.hi - outer_.box.lo, down = outer_.box.hi - box.lo;
    return std::min({up.x, up.y, up.z, down.x, down.y, down.z}) + floor_;
  }

  /// Bounds the depth of a piece by the triangle nearest to its middle. The side on which it lies, if it is not known,
  /// is found out only when its turn comes.
  void look_at(TrianglePiece piece) {
    ++effort_;
    const Vec3 middle = piece.polygon.middle();
    for (const Vec3& vertex : piece.polygon) piece.radius = std::max(piece.radius, norm(vertex - middle));
    if (piece.near.empty() && !piece.is_settled) {
      const std::optional<bool> side = known_side(piece);
      if (side == false) return;
      piece.is_settled = side.has_value();
    }
    const auto known = measure::point_distance(middle, outer_.triangle(piece.nearest), kInfinity);
    auto nearest = measure::nearest_point(outer_.placed, middle, known.distance + 4 * known.margin);
    if (!nearest) nearest = measure::nearest_point(outer_.placed, middle, kInfinity);  // by a rounding
    if (!nearest) return;
    piece.nearest = last_nearest_ = nearest->triangle, piece.distance = nearest->distance, piece.error = nearest->error;
    piece.most = farthest_from(outer_.triangle(nearest->triangle), piece.polygon) + piece.drift + floor_;
    if (!piece.is_settled || examine(piece)) keep(std::move(piece));
  }

  // Depth is 0 outside, and the depths of two points differ by no more than their distance: if the middle of a piece of
  // radius r has the depth d, no point of it is deeper than d + r, and if the middle is outside and farther than r from
  // the boundary, no point is inside. Nor is any point farther from the boundary than the farthest vertex of the piece
  // is from any one triangle, since distance from a convex set is convex.
  /// Finds out on which side a piece lies; returns false if nothing of it that counts is inside.
  bool examine(TrianglePiece& piece) {
    piece.is_examined = true;
    const double slack = piece.drift + floor_;
    // Beside triangles the side of the middle says little, unless it is deeper than what is known, or far from them.
    if (!piece.near.empty() && piece.distance <= std::max(least_, piece.radius / 2)) return true;
    if (!find_side(piece)) return false;
    const double least = piece.distance - piece.error - slack;
    if (piece.is_inside && least > least_) least_ = least, deepest_ = piece.polygon.middle();
    const double reach = piece.radius * (1 + 0x1p-40) + piece.error + slack;
    piece.most = std::min(piece.most, (piece.is_inside ? 1 : -1) * piece.distance + reach);
    return piece.is_inside || piece.distance <= reach;
  }

  /// Finds out on which side the middle of a piece is, and whether all of the piece is inside; returns false if all of
  /// it is outside.
  bool find_side(TrianglePiece& piece) {
    if (piece.is_settled) return piece.is_inside = true;
    if (piece.near.empty())
      if (const auto side = known_side(piece)) return piece.is_settled = piece.is_inside = *side;
    const Vec3 middle = piece.polygon.middle();
    const double winding = winding_.at(middle);
    piece.is_inside = winding > 0.5;
    const double reach = reach_of_side(winding_, winding, middle, std::max(piece.distance, kFarther * piece.radius));
    if (!piece.near.empty()) return true;
    if (piece.radius < reach) {
      keep_side(piece.polygon, piece.is_inside, reach - piece.radius);
    } else {
      const bool is_clear = winding < 0.25 || winding > 0.75;
      if (!is_clear || side_of_corners(piece.polygon) != piece.is_inside) return true;
    }
    return piece.is_settled = piece.is_inside;
  }

  /// The side of a piece that touches no triangle, where a corner's side is known to go on over all of it.
  std::optional<bool> known_side(const TrianglePiece& piece) {
    for (const Vec3& corner : piece.polygon) {
      const auto at = corner_numbers_.find(corner);
      if (!at || !(corners_[*at].reach > 2 * piece.radius)) continue;
      const auto [is_inside, reach, number] = corners_[*at];
      keep_side(piece.polygon, is_inside, reach - 2 * piece.radius);
      return is_inside;
    }
    return std::nullopt;
  }

  PieceCorner& corner_at(const Vec3& point) {
    const std::uint32_t at = corner_numbers_.add(point);
    if (at == corners_.size()) corners_.emplace_back();
    return corners_[at];
  }

  void keep_side(const Polygon& polygon, bool is_inside, double reach) {
    for (const Vec3& vertex : polygon) {
      PieceCorner& corner = corner_at(vertex);
      if (reach > corner.reach) corner.is_inside = is_inside, corner.reach = reach;
    }
  }

  /// Whether all corners of a polygon are inside, or all outside; nothing if neither.
  [[nodiscard]] std::optional<bool> side_of_corners(const Polygon& polygon) {
    double least = kInfinity, most = 0;
    for (const Vec3& vertex : polygon) {
      PieceCorner& corner = corner_at(vertex);
      if (!corner.winding) corner.winding = winding_.at(vertex);
      least = std::min(least, *corner.winding), most = std::max(most, *corner.winding);
      if (least < 0.75 && most > 0.25) return std::nullopt;
    }
    return least > 0.5;
  }

  void keep(TrianglePiece piece) {
    if (piece.most <= std::max(nothing_, goal_.enough) || (piece.is_examined && piece.drift > most_drift_)) {
      laid_aside_ = std::max(laid_aside_, piece.most);
      return;
    }
    if (free_.empty()) free_.push_back(pieces_.size()), pieces_.emplace_back();
    open_.push({piece.most, free_.back()});
    pieces_[free_.back()] = std::move(piece);
    free_.pop_back();
  }

  TrianglePiece pop() {
    TrianglePiece piece = std::move(pieces_[open_.top().piece]);
    free_.push_back(open_.top().piece);
    open_.pop();
    return piece;
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
    const std::size_t before = piece.near.size();
    while (!piece.near.empty() && !are_near(piece.polygon, outer_.triangle(piece.near.back()), near_))
      piece.near.pop_back();
    effort_ += (before - piece.near.size()) / kTrianglesAPoint;
    if (piece.near.empty() && !piece.is_settled && !find_side(piece)) return;
    // A new vertex is rounded once, after a multiple of a difference of two that are no farther apart than 2 radii.
    const double drift = piece.drift + 1.75 * 0x1p-8 * most_drift_ + 0x1p-51 * piece.radius;
    const Cut parts = part(piece);
    for (const Polygon* one : {&parts.within, &parts.beyond}) {
      if (one->size() == 0) continue;
      effort_ += piece.near.size() / kBoxesAPoint;
      look_at({*one, drift, near_among(piece.near, *one), piece.nearest, piece.is_settled});
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

  static constexpr double kFarther = 16;  ///< radii: no open edge beyond is looked for
  /// So many boxes, and so many triangles held against a polygon, take as much time as one point.
  static constexpr std::size_t kBoxesAPoint = 256, kTrianglesAPoint = 64;

  const solid::Body &inner_, &outer_;
  const Winding& winding_;
  std::span<const TrianglePair> touching_;
  const DepthGoal& goal_;
  double most_drift_;  ///< w above
  double near_ = 3.5 * most_drift_, beside_ = 4 * most_drift_;
  double nothing_ = std::max(8 * most_drift_, goal_.nothing);  ///< a depth up to this counts as 0
  double floor_ = 0x1p-3 * most_drift_;                        ///< the rounding error of a length
  double least_ = 0;                                           ///< some point is at least so deep:
  Vec3 deepest_{};                                             ///< this one
  double laid_aside_ = 0;                                      ///< no piece that was laid aside is deeper
  struct Open {
    double most;
    std::size_t piece;
    friend bool operator<(const Open& p, const Open& q) { return p.most < q.most; }
  };
  std::priority_queue<Open> open_;
  std::vector<TrianglePiece> pieces_;
  std::vector<std::size_t> free_;  ///< places in it
  std::uint32_t last_nearest_ = 0;
  /// Pieces share corners.
  PointTable corner_numbers_;
  std::vector<PieceCorner> corners_;
  std::uint64_t effort_ = 0;  ///< in points examined
};

}  // namespace

std::vector<TrianglePair> touching_pairs(const solid::Body& a, const solid::Body& b, const std::stop_token& stop) {
  std::vector<TrianglePair> pairs;
  const auto take = [&](const TrianglePair& pair) { return pairs.push_back(pair), true; };
  measure::near_pairs(a.placed, b.placed, 5 * Search::most_drift(a, b), take, stop);
  return pairs;
}

Depth depth_in(const DepthSearch& search, const DepthGoal& goal) { return Search(search, goal).run(); }

Interval depth_in(const solid::Body& inner, const solid::Body& outer, const DepthGoal& goal) {
  const Winding winding{[&](const Vec3& p) { return std::abs(solid::winding_number(outer.placed, p).value_or(0)); }};
  return depth_in({inner, outer, winding, touching_pairs(inner, outer, goal.stop)}, goal);
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
