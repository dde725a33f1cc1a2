// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/passing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "clash/local_frame.hpp"
#include "clash/pseudo_normal.hpp"
#include "clash/sheets.hpp"
#include "clash/slab.hpp"
#include "core/disjoint_sets.hpp"
#include "measure/nearest.hpp"
#include "measure/triangle_distance.hpp"

namespace impinge::clash {
namespace {

/// Where two sheets are near each other.
struct Place {
  SidesSeen a_at_b, b_at_a;
  Box box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};  ///< of what is near

  static constexpr double kFar = std::numeric_limits<double>::infinity();
};

class Passing {
 public:
  Passing(const LinkedPart& a, const LinkedPart& b, double tolerance)
      : a_(a.part.body), b_(b.part.body), tolerance_(tolerance), frame_(local_frame(a_.box, b_.box)) {}

  /// Grows the box of what `own` has near the other's triangle, and returns the sides of the triangle on which it goes
  /// on. They are not looked for on those that are `known`.
  std::uint8_t see(const Triangle& own, const LinkedPart& others, std::uint32_t other, std::uint8_t known,
                   Box& near) const {
    const Triangle seen_from = frame_.to_local(others.part.body.triangle(other));
    const auto slab = make_slab(seen_from, frame_.unit * tolerance_, frame_.scale);
    if (!slab || !slab->has_plane) return 0;
    const Triangle local = frame_.to_local(own);
    for (const Vec3& point : cut(cut(between(local, *slab), slab->top).within, slab->bottom).within)
      near.lo = min(near.lo, point), near.hi = max(near.hi, point);
    const std::uint8_t found = over(local, *slab, seen_from, others.part.body, known);
    return found | around(local, *slab, others, other, known | found);
  }

  /// A point has no length: what two sheets that meet in one have near each other is longer than the tolerance only as
  /// far as the angle between them is flat.
  [[nodiscard]] bool is_long(const Box& near) const {
    constexpr double kLong = 16;
    return !is_empty(near) && norm(near.hi - near.lo) > kLong * frame_.unit * tolerance_;
  }

 private:
  static constexpr std::uint8_t kBoth = kAbove | kBelow;

  static Polygon between(const Triangle& triangle, const Slab& slab) {
    Polygon piece(triangle);
    for (std::size_t i = 0; i < slab.size && piece.size() > 0; ++i) piece = cut(piece, slab.sides[i]).within;
    return piece;
  }

  /// What goes on over the triangle, however far.
  [[nodiscard]] std::uint8_t over(const Triangle& own, const Slab& slab, const Triangle& seen_from,
                                  const solid::Body& others, std::uint8_t known) const {
    Polygon piece = between(own, slab);
    const auto sides = sides_of(seen_from);
    for (std::size_t i = 0; i < 3 && piece.size() > 0; ++i) piece = cut(piece, sides[i]).within;
    if (piece.size() == 0) return 0;
    const Cut top = cut(piece, slab.top), bottom = cut(piece, slab.bottom);
    std::uint8_t found = 0;
    for (const auto& [side, beyond] : {std::pair(kAbove, &top.beyond), {kBelow, &bottom.beyond}})
      if ((known & side) == 0 && beyond->size() > 0 && goes_on(*beyond, seen_from, others)) found |= side;
    return found;
  }

  /// What goes on close to the triangle, but perhaps beyond its edges: over none of the triangles there, if they are
  /// the legs of a fold.
  [[nodiscard]] std::uint8_t around(const Triangle& own, const Slab& slab, const LinkedPart& others,
                                    std::uint32_t other, std::uint8_t known) const {
    if (known == kBoth) return 0;
    constexpr double kWider = 3;
    Slab wide = slab;
    for (HalfSpace* side : {&wide.top, &wide.bottom}) side->offset += kWider * frame_.unit * tolerance_;
    for (std::size_t i = 0; i < wide.size; ++i) wide.sides[i].offset += kWider * frame_.unit * tolerance_;
    const Polygon piece = cut(cut(between(own, wide), wide.top).within, wide.bottom).within;
    if (piece.size() == 0) return 0;
    std::uint8_t found = 0;
    const auto try_at = [&](const Vec3& point) {
      if ((known | found) != kBoth) found |= side_of(point, others, other, static_cast<std::uint8_t>(known | found));
    };
    try_at(piece.middle());
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Vec3 &vertex = piece[i], &next = piece[(i + 1) % piece.size()];
      try_at(vertex), try_at(0.5 * (vertex + next));
    }
    return found;
  }

  /// On which side of the other body a point is that is farther than the tolerance from it and has its nearest point on
  /// a triangle of it; 0 if that is none or one of those that are `known`.
  [[nodiscard]] std::uint8_t side_of(const Vec3& point, const LinkedPart& others, std::uint32_t other,
                                     std::uint8_t known) const {
    const Triangle triangle = frame_.to_local(others.part.body.triangle(other));
    const measure::TriangleDistance nearest = measure::point_distance(point, triangle, kFarthest);
    if (!(nearest.distance > frame_.unit * tolerance_)) return 0;
    const auto normal = pseudo_normal(others, frame_, {other, nearest.b, frame_.unit * tolerance_ / 64});
    if (!normal) return 0;
    const double height = dot(*normal, point - nearest.b);
    // In a face's plane, or that of two which are folded up flat, there are no sides.
    if (!(std::abs(height) > 0x1p-10 * nearest.distance)) return 0;
    const std::uint8_t side = height > 0 ? kAbove : kBelow;
    return (known & side) == 0 && is_seen(point, triangle, others.part.body) ? side : std::uint8_t{0};
  }

  /// Across the triangle's plane along its edges, a little wider than it: what runs along an edge is seen from one of
  /// the triangles there at least.
  [[nodiscard]] std::array<HalfSpace, 3> sides_of(const Triangle& t) const {
    const Vec3 up = cross(t[1] - t[0], t[2] - t[0]);
    std::array<HalfSpace, 3> sides;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 across = cross(t[(i + 1) % 3] - t[i], up);
      const Vec3 normal = (1 / norm(across)) * across;
      sides[i] = {normal, dot(normal, t[i]) + frame_.unit * tolerance_ / 16};
    }
    return sides;
  }

  /// Whether a point is farther than the tolerance from the other body, and of that body no nearer to another triangle:
  /// what passes beyond the triangle's end, before another face, is that one's to tell.
  [[nodiscard]] bool is_seen(const Vec3& point, const Triangle& triangle, const solid::Body& body) const {
    const Vec3 world = frame_.to_world(point);
    if (measure::nearest_point(body.placed, world, tolerance_, tolerance_)) return false;
    constexpr double kNearer = 1 - 0x1p-20;
    const double distance = measure::point_distance(point, triangle, kFarthest).distance / frame_.unit;
    return !measure::nearest_point(body.placed, world, kNearer * distance, kNearer * distance);
  }

  /// Whether some of the points that are tried is seen from the triangle.
  [[nodiscard]] bool goes_on(const Polygon& piece, const Triangle& triangle, const solid::Body& body) const {
    const auto seen = [&](const Vec3& point) { return is_seen(point, triangle, body); };
    const Vec3 middle = piece.middle();
    if (seen(middle)) return true;
    return std::any_of(piece.begin(), piece.end(), [&](const Vec3& vertex) {
      // Close to where the piece leaves the triangle other faces are the farthest away.
      constexpr std::array kShares{0.0, 0x1p-6, 0x1p-3, 0x1p-1};
      return std::any_of(kShares.begin(), kShares.end(),
                         [&](double share) { return seen(vertex + share * (middle - vertex)); });
    });
  }

  static constexpr double kFarthest = std::numeric_limits<double>::infinity();

  const solid::Body &a_, &b_;
  double tolerance_;
  LocalFrame frame_;
};

/// Every near pair, those that the encounter left out too.
void each_near(const LinkedPart& a, const LinkedPart& b, double tolerance, const Encounter& encounter,
               const measure::TakePair& take, const std::stop_token& stop) {
  if (!encounter.is_whole) return measure::near_pairs(a.part.body.placed, b.part.body.placed, tolerance, take, stop);
  for (const TrianglePair& pair : encounter.near)
    if (stop.stop_requested() || !take(pair)) return;
}

}  // namespace

bool pass_through(const LinkedPart& a, const LinkedPart& b, double tolerance, const Encounter& encounter,
                  const std::stop_token& stop) {
  std::vector<std::uint32_t> ids_a, ids_b;
  for (const TrianglePair& pair : encounter.near) ids_a.push_back(pair.a), ids_b.push_back(pair.b);
  const Sheets of_a = sheets_of(a.part, std::move(ids_a)), of_b = sheets_of(b.part, std::move(ids_b));
  const auto count_a = static_cast<std::uint32_t>(of_a.ids.size());
  const auto is_proper = [&](const TrianglePair& pair) {
    return a.part.is_boundary(pair.a) && b.part.is_boundary(pair.b);
  };
  DisjointSets groups(of_a.ids.size() + of_b.ids.size());
  const auto join = [&](const TrianglePair& pair) {
    if (is_proper(pair)) groups.join(of_a.index(pair.a), count_a + of_b.index(pair.b));
    return true;
  };
  each_near(a, b, tolerance, encounter, join, stop);

  const Passing passing(a, b, tolerance);
  std::map<std::array<std::uint32_t, 3>, Place> places;
  bool pass = false;
  const auto look_at = [&](const TrianglePair& pair) {
    if (!is_proper(pair)) return true;
    const std::uint32_t i = of_a.index(pair.a), j = of_b.index(pair.b);
    Place& place = places[{groups.find(i), of_a.cluster[i], of_b.cluster[j]}];
    const Triangle own_a = a.part.body.triangle(pair.a), own_b = b.part.body.triangle(pair.b);
    const std::uint8_t known_a = place.b_at_a.from(of_a, i), known_b = place.a_at_b.from(of_b, j);
    place.b_at_a.add(of_a, i, passing.see(own_b, a, pair.a, known_a, place.box));
    place.a_at_b.add(of_b, j, passing.see(own_a, b, pair.b, known_b, place.box));
    pass = place.a_at_b.has_both() && place.b_at_a.has_both() && passing.is_long(place.box);
    return !pass;
  };
  each_near(a, b, tolerance, encounter, look_at, stop);
  return pass;
}

}  // namespace impinge::clash
