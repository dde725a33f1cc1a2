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
  /// sides of the triangle on which it is far. They are not looked for on those that are `known`.
  std::uint8_t see(const Triangle& own, const Triangle& other, const solid::Body& others, std::uint8_t known,
                   Box& near) const {
    const auto slab = make_slab(frame_.to_local(other), frame_.unit * tolerance_, frame_.scale);
    if (!slab || !slab->has_plane) return 0;
    Polygon piece(frame_.to_local(own));
    for (std::size_t i = 0; i < slab->size && piece.size() > 0; ++i) piece = cut(piece, slab->sides[i]).within;
    if (piece.size() == 0) return 0;
    const Cut top = cut(piece, slab->top), bottom = cut(piece, slab->bottom);
    if (top.within.size() > 0)
      for (const Vec3& point : cut(top.within, slab->bottom).within)
        near.lo = min(near.lo, point), near.hi = max(near.hi, point);
    std::uint8_t sides = 0;
    for (const auto& [side, beyond] : {std::pair(kAbove, &top.beyond), {kBelow, &bottom.beyond}})
      if ((known & side) == 0 && beyond->size() > 0 && is_far(*beyond, others)) sides |= side;
    return sides;
  }

  /// A point has no length: what two sheets that meet in one have near each other is longer than the tolerance only as
  /// far as the angle between them is flat.
  [[nodiscard]] bool is_long(const Box& near) const {
    constexpr double kLong = 16;
    return !is_empty(near) && norm(near.hi - near.lo) > kLong * frame_.unit * tolerance_;
  }

 private:
  /// Of the points that are tried.
  [[nodiscard]] bool is_far(const Polygon& piece, const solid::Body& body) const {
    const auto is_far = [&](const Vec3& point) {
      return !measure::nearest_point(body.placed, frame_.to_world(point), tolerance_, tolerance_);
    };
    return is_far(piece.middle()) || std::any_of(piece.begin(), piece.end(), is_far);
  }

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
