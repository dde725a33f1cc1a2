// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "clash/regions/lines.hpp"

namespace impinge::clash {
namespace {

struct Plane {
  Vec3 origin, normal;
};

/// The plane through the two edges that are farthest from parallel; nothing where the sine of their angle is small.
std::optional<Plane> plane_of(const Triangle& t) {
  constexpr double kLeastSine = 0.125;
  const auto direction = [](const Vec3& from, const Vec3& to) { return (1 / norm(to - from)) * (to - from); };
  const std::array along{direction(t[0], t[1]), direction(t[1], t[2]), direction(t[2], t[0])};
  Plane best{{}, {}};
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 normal = cross(along[(i + 2) % 3], along[i]);
    const double sine = norm(normal);
    if (sine > most) most = sine, best = {t[i], (1 / sine) * normal};
  }
  return most >= kLeastSine ? std::optional(best) : std::nullopt;
}

double farthest_from(const Plane& plane, const Triangle& t) {
  double most = 0;
  for (const Vec3& p : t) most = std::max(most, std::abs(dot(plane.normal, p - plane.origin)));
  return most;
}

struct Point2 {
  double x, y;
};
Point2 operator-(const Point2& p, const Point2& q) { return {p.x - q.x, p.y - q.y}; }
double cross(const Point2& p, const Point2& q) { return p.x * q.y - p.y * q.x; }
double length(const Point2& p) { return std::sqrt(p.x * p.x + p.y * p.y); }

/// Whether two sets of points are farther apart than `gap` along the normal of a line.
template <class Points, class Others>
bool are_apart_across(const Point2& from, const Point2& to, const Points& points, const Others& others, double gap) {
  const Point2 along = to - from;
  const double size = length(along);
  if (!(size > 0)) return false;
  const Point2 across{-along.y / size, along.x / size};
  const auto range = [&](const auto& some) {
    double lo = 1e300, hi = -1e300;
    for (const Point2& p : some) {
      const double at = across.x * (p.x - from.x) + across.y * (p.y - from.y);
      lo = std::min(lo, at), hi = std::max(hi, at);
    }
    return std::pair(lo, hi);
  };
  const auto [lo, hi] = range(points);
  const auto [lo_other, hi_other] = range(others);
  return lo > hi_other + gap || lo_other > hi + gap;
}

/// Projects the piece and the triangles that lie flat on it along the normal of the whole triangle.
///
/// Heights of a triangle's vertices over the other's plane are off by the length to them, 3.5 largest coordinates at
/// most, times the error of the normal, 2^-50 over the sine, which is below w; so with heights of w at most the two
/// are within 2 w of each other wherever one lies over the other, or 2.1 w along the whole's normal. Projected points
/// are off by less than w / 8, and the true points of the piece are within another w of the computed ones.
class Cover {
 public:
  Cover(const CoverSearch& search, const Plane& plane) : search_(search), plane_(plane) {
    const Vec3 axis = abs(plane.normal).x < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = cross(plane.normal, axis);
    u_ = (1 / norm(u)) * u, v_ = cross(plane.normal, u_);
    for (const Vec3& p : search.piece) piece_.push_back(seen(p));
  }

  /// Let U be the union of the flat triangles. If it holds one point of the piece and not another, then somewhere on
  /// the way from one to the other, which can be chosen to meet no vertex, U ends: at an edge over the piece, of a flat
  /// triangle. But if each of those is the edge of another flat one on its other side too, U does not end there.
  [[nodiscard]] bool is_whole() {
    if (!holds_one_point()) return false;
    for (const std::uint32_t t : search_.near)
      if (const Triangle triangle = search_.other.triangle(t); is_flat(triangle)) list_edges(triangle);
    std::sort(edges_.begin(), edges_.end(), [](const Edge& p, const Edge& q) { return before(p, q); });
    for (auto first = edges_.begin(), last = first; first != edges_.end(); first = last) {
      bool has_left = false, has_right = false;
      for (; last != edges_.end() && !before(*first, *last); ++last)
        has_left |= last->side > 0, has_right |= last->side < 0;
      if (!has_left || !has_right) return false;
    }
    return true;
  }

 private:
  struct Edge {
    Vec3 from, to;
    int side;  ///< the side on which the triangle lies; 0 where that is not certain
  };
  static bool before(const Edge& p, const Edge& q) {
    const auto key = [](const Edge& e) { return std::tie(e.from.x, e.from.y, e.from.z, e.to.x, e.to.y, e.to.z); };
    return key(p) < key(q);
  }

  [[nodiscard]] Point2 seen(const Vec3& p) const {
    const Vec3 from = p - plane_.origin;
    return {dot(u_, from), dot(v_, from)};
  }

  [[nodiscard]] bool is_flat(const Triangle& t) const {
    constexpr double kCosine = 0.99;
    const auto plane = plane_of(t);
    if (!plane || std::abs(dot(plane->normal, plane_.normal)) < kCosine) return false;
    return farthest_from(plane_, t) <= search_.w || farthest_from(*plane, search_.whole) <= search_.w;
  }

  /// On which side of an edge a point lies; 0 if rounding may have put it there.
  [[nodiscard]] int side(const Point2& from, const Point2& to, const Point2& p) const {
    const double turn = cross(to - from, p - from);
    if (!(std::abs(turn) > 2 * search_.w * (length(to - from) + length(p - from)))) return 0;
    return turn > 0 ? 1 : -1;
  }

  /// Tests one point of the piece: not its middle, through which edges of regular meshes often run.
  [[nodiscard]] bool holds_one_point() const {
    const Polygon& piece = search_.piece;
    const Point2 p = seen(0.71 * piece.middle() + 0.18 * piece[0] + 0.11 * piece[1]);
    return std::any_of(search_.near.begin(), search_.near.end(), [&](std::uint32_t t) {
      const Triangle triangle = search_.other.triangle(t);
      const std::array corners{seen(triangle[0]), seen(triangle[1]), seen(triangle[2])};
      const int first = side(corners[0], corners[1], p);
      return first != 0 && side(corners[1], corners[2], p) == first && side(corners[2], corners[0], p) == first &&
             is_flat(triangle);
    });
  }

  void list_edges(const Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const bool is_turned = less(t[j], t[i]);
      const Vec3 &from = t[is_turned ? j : i], &to = t[is_turned ? i : j];
      const Point2 seen_from = seen(from), seen_to = seen(to);
      if (is_over_piece(seen_from, seen_to))
        edges_.push_back({from, to, side(seen_from, seen_to, seen(t[(i + 2) % 3]))});
    }
  }

  [[nodiscard]] bool is_over_piece(const Point2& from, const Point2& to) const {
    const std::array edge{from, to};
    const double gap = 2 * search_.w;
    if (are_apart_across(from, to, piece_, edge, gap)) return false;
    for (std::size_t i = 0; i < piece_.size(); ++i)
      if (are_apart_across(piece_[i], piece_[(i + 1) % piece_.size()], piece_, edge, gap)) return false;
    return true;
  }

  const CoverSearch& search_;
  Plane plane_;
  Vec3 u_, v_;
  std::vector<Point2> piece_;
  std::vector<Edge> edges_;
};

}  // namespace

bool is_covered(const CoverSearch& search) {
  const auto plane = plane_of(search.whole);
  return plane && Cover(search, *plane).is_whole();
}

}  // namespace impinge::clash
