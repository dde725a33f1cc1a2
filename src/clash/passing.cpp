// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/passing.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>

#include "clash/local_frame.hpp"
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

  /// What `own` has between the sides of the other's triangle: grows the box of what of it is near, and returns the
  /// sides of the triangle on which it goes on. They are not looked for on those that are `known`.
  std::uint8_t see(const Triangle& own, const Triangle& other, const solid::Body& others, std::uint8_t known,
                   Box& near) const {
    const Triangle seen_from = frame_.to_local(other);
    const auto slab = make_slab(seen_from, frame_.unit * tolerance_, frame_.scale);
    if (!slab || !slab->has_plane) return 0;
    Polygon piece(frame_.to_local(own));
    for (std::size_t i = 0; i < slab->size && piece.size() > 0; ++i) piece = cut(piece, slab->sides[i]).within;
    if (piece.size() == 0) return 0;
    for (const Vec3& point : cut(cut(piece, slab->top).within, slab->bottom).within)
      near.lo = min(near.lo, point), near.hi = max(near.hi, point);
    const auto sides = sides_of(seen_from);
    for (std::size_t i = 0; i < 3 && piece.size() > 0; ++i) piece = cut(piece, sides[i]).within;
    if (piece.size() == 0) return 0;
    const Cut top = cut(piece, slab->top), bottom = cut(piece, slab->bottom);
    std::uint8_t found = 0;
    for (const auto& [side, beyond] : {std::pair(kAbove, &top.beyond), {kBelow, &bottom.beyond}})
      if ((known & side) == 0 && beyond->size() > 0 && goes_on(*beyond, seen_from, others)) found |= side;
    return found;
  }

  /// A point has no length: what two sheets that meet in one have near each other is longer than the tolerance only as
  /// far as the angle between them is flat.
  [[nodiscard]] bool is_long(const Box& near) const {
    constexpr double kLong = 16;
    return !is_empty(near) && norm(near.hi - near.lo) > kLong * frame_.unit * tolerance_;
  }

 private:
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

  /// Whether some of the points that are tried is farther than the tolerance from the other body, and of that body no
  /// nearer to another triangle: what passes beyond the triangle's end, before another face, is that one's to tell.
  [[nodiscard]] bool goes_on(const Polygon& piece, const Triangle& triangle, const solid::Body& body) const {
    const auto is_seen = [&](const Vec3& point) {
      const Vec3 world = frame_.to_world(point);
      if (measure::nearest_point(body.placed, world, tolerance_, tolerance_)) return false;
      constexpr double kNearer = 1 - 0x1p-20;
      const double distance = measure::point_distance(point, triangle, kFarthest).distance / frame_.unit;
      return !measure::nearest_point(body.placed, world, kNearer * distance, kNearer * distance);
    };
    const Vec3 middle = piece.middle();
    if (is_seen(middle)) return true;
    return std::any_of(piece.begin(), piece.end(), [&](const Vec3& vertex) {
      // Close to where the piece leaves the triangle other faces are the farthest away.
      constexpr std::array kShares{0.0, 0x1p-6, 0x1p-3, 0x1p-1};
      return std::any_of(kShares.begin(), kShares.end(),
                         [&](double share) { return is_seen(vertex + share * (middle - vertex)); });
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
    const Triangle triangle_a = a.part.body.triangle(pair.a), triangle_b = b.part.body.triangle(pair.b);
    const std::uint8_t known_a = place.b_at_a.from(of_a, i), known_b = place.a_at_b.from(of_b, j);
    place.b_at_a.add(of_a, i, passing.see(triangle_b, triangle_a, a.part.body, known_a, place.box));
    place.a_at_b.add(of_b, j, passing.see(triangle_a, triangle_b, b.part.body, known_b, place.box));
    pass = place.a_at_b.has_both() && place.b_at_a.has_both() && passing.is_long(place.box);
    return !pass;
  };
  each_near(a, b, tolerance, encounter, look_at, stop);
  return pass;
}

}  // namespace impinge::clash
