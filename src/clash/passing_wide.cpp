// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "clash/fold_side.hpp"
#include "clash/local_frame.hpp"
#include "clash/passing.hpp"
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

/// What of a part is near a triangle of the other's.
struct NearTriangles {
  struct Entry {
    Triangle local;
    std::uint32_t piece;
  };
  std::vector<Entry> entries;  ///< where there are several pieces
  std::optional<std::uint32_t> first;
  bool has_several = false;

  /// Of a triangle that is near.
  void note(std::uint32_t piece) {
    has_several |= first && *first != piece;
    first = piece;
  }
};

/// What is held of them; where there is more, nothing is seen along branches.
constexpr std::size_t kMostNearBranches = std::size_t{1} << 20;

class Passing {
 public:
  Passing(const LinkedPart& a, const LinkedPart& b, double tolerance)
      : a_(a.part.body), b_(b.part.body), tolerance_(tolerance), frame_(local_frame(a_.box, b_.box)) {}

  /// Grows the box of what `own` has near the other's triangle, and returns the sides of the triangle on which it goes
  /// on. They are not looked for on those that are `known`.
  std::uint8_t see(const Triangle& own, const PartTriangle& other, bool is_bent, std::uint8_t known, Box& near) const {
    const auto slab = make_slab(other.local, frame_.unit * tolerance_, frame_.scale);
    if (!slab || !slab->has_plane) return 0;
    const Polygon piece = between(Polygon(own), *slab);
    for (const Vec3& point : along(piece, *slab)) near.lo = min(near.lo, point), near.hi = max(near.hi, point);
    const std::uint8_t found = over(piece, *slab, other, known);
    return is_bent ? found | around(own, *slab, other, known | found) : found;
  }

  /// Where `own` lies on other pieces of a sheet that branches, and so never far from it: the sides of the triangle on
  /// which it does are added to those of the sheets that the triangle's piece makes with the rest. Sheets that are
  /// `lain` upon are left out: where an area in common ends it is for both to go on, which is not asked here.
  void see_along(const Triangle& own, const PartTriangle& other, std::uint32_t index, const Sheets& sheets,
                 const NearTriangles& near, const std::vector<bool>& lain, SidesSeen& seen) const {
    if (lain[sheets.piece[index]]) return;
    const auto slab = make_slab(other.local, frame_.unit * tolerance_, frame_.scale);
    if (!slab || !slab->has_plane) return;
    const Polygon piece = over(between(Polygon(own), *slab), other);
    if (piece.size() == 0) return;
    const Cut top = cut(piece, slab->top), bottom = cut(piece, slab->bottom);
    for (const auto& [side, beyond] : {std::pair(kAbove, &top.beyond), {kBelow, &bottom.beyond}}) {
      std::vector<std::uint32_t> on;
      const auto is_along = [&](const Vec3& point) {
        on = pieces_at(point, near);
        return is_between(point, other, sheets.links[sheets.piece[index]], near, on);
      };
      if (beyond->size() == 0 || !some_point(*beyond, is_along)) continue;
      for (const Sheets::Link& link : sheets.links[sheets.piece[index]])
        if (lain[link.piece]) on.push_back(link.piece);
      seen.add_between(sheets, index, side, on);
    }
  }

  /// Whether of two triangles that are flat to each other one has some of the other within the tolerance.
  [[nodiscard]] bool lie_along(const Triangle& own, const Triangle& other) const {
    const Vec3 of_own = cross(own[1] - own[0], own[2] - own[0]),
               of_other = cross(other[1] - other[0], other[2] - other[0]);
    if (!(norm(cross(of_own, of_other)) < 0.5 * norm(of_own) * norm(of_other))) return false;
    const auto slab = make_slab(other, frame_.unit * tolerance_, frame_.scale);
    if (!slab || !slab->has_plane) return false;
    Polygon piece = along(Polygon(own), *slab);
    const auto sides = sides_of(other);
    for (std::size_t i = 0; i < 3 && piece.size() > 0; ++i) piece = cut(piece, sides[i]).within;
    double area = 0, outline = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Vec3 &from = piece[i], &to = piece[(i + 1) % piece.size()];
      area += norm(cross(from - piece[0], to - piece[0])) / 2, outline += norm(to - from);
    }
    // Next to each other they have as much in common as triangles are taken wider than they are.
    return area > frame_.unit * tolerance_ / 8 * outline;
  }

  [[nodiscard]] PartTriangle triangle(const LinkedPart& part, std::uint32_t id) const {
    return {part, frame_, id, frame_.to_local(part.part.body.triangle(id))};
  }

  /// A point has no length: what two sheets that meet in one have near each other is longer than the tolerance only as
  /// far as the angle between them is flat.
  [[nodiscard]] bool is_long(const Box& near) const {
    constexpr double kLong = 16;
    return !is_empty(near) && norm(near.hi - near.lo) > kLong * frame_.unit * tolerance_;
  }

 private:
  static constexpr std::uint8_t kBoth = kAbove | kBelow;

  static Polygon between(Polygon piece, const Slab& slab) {
    for (std::size_t i = 0; i < slab.size && piece.size() > 0; ++i) piece = cut(piece, slab.sides[i]).within;
    return piece;
  }
  static Polygon along(const Polygon& piece, const Slab& slab) {
    return cut(cut(piece, slab.top).within, slab.bottom).within;
  }

  [[nodiscard]] Polygon over(Polygon piece, const PartTriangle& other) const {
    const auto sides = sides_of(other.local);
    for (std::size_t i = 0; i < 3 && piece.size() > 0; ++i) piece = cut(piece, sides[i]).within;
    return piece;
  }

  /// What goes on over the triangle, however far.
  [[nodiscard]] std::uint8_t over(Polygon piece, const Slab& slab, const PartTriangle& other,
                                  std::uint8_t known) const {
    piece = over(std::move(piece), other);
    if (piece.size() == 0) return 0;
    const Cut top = cut(piece, slab.top), bottom = cut(piece, slab.bottom);
    std::uint8_t found = 0;
    for (const auto& [side, beyond] : {std::pair(kAbove, &top.beyond), {kBelow, &bottom.beyond}})
      if ((known & side) == 0 && beyond->size() > 0 && goes_on(*beyond, other)) found |= side;
    return found;
  }

  /// What goes on close to the triangle, but beyond its edges: over none of those that meet there, if it is on the
  /// outer side of a fold.
  [[nodiscard]] std::uint8_t around(const Triangle& own, Slab slab, const PartTriangle& other,
                                    std::uint8_t known) const {
    if (known == kBoth) return 0;
    const double wider = 3 * frame_.unit * tolerance_;
    slab.top.offset += wider, slab.bottom.offset += wider;
    for (std::size_t i = 0; i < slab.size; ++i) slab.sides[i].offset += wider;
    const Polygon piece = along(between(Polygon(own), slab), slab);
    if (piece.size() == 0) return 0;
    std::uint8_t found = 0;
    const auto try_at = [&](const Vec3& point) {
      const std::uint8_t side = side_of_fold(other, point, frame_.unit * tolerance_);
      if ((side & ~(known | found)) != 0 && is_seen(point, other)) found |= side;
    };
    try_at(piece.middle());
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Vec3 &vertex = piece[i], &next = piece[(i + 1) % piece.size()];
      try_at(vertex), try_at(0.5 * (vertex + next));
    }
    return found;
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
  [[nodiscard]] bool is_seen(const Vec3& point, const PartTriangle& triangle) const {
    const auto& body = triangle.part.part.body.placed;
    const Vec3 world = frame_.to_world(point);
    if (measure::nearest_point(body, world, tolerance_, tolerance_)) return false;
    constexpr double kNearer = 1 - 0x1p-20;
    const double distance = measure::point_distance(point, triangle.local, kFarthest).distance / frame_.unit;
    return !measure::nearest_point(body, world, kNearer * distance, kNearer * distance);
  }

  [[nodiscard]] double distance(const Vec3& point, const Triangle& t) const {
    return measure::point_distance(point, t, kFarthest).distance / frame_.unit;
  }

  /// On which pieces of the other part a point lies, to within the tolerance.
  [[nodiscard]] std::vector<std::uint32_t> pieces_at(const Vec3& point, const NearTriangles& near) const {
    std::vector<std::uint32_t> pieces;
    for (const auto& [local, piece] : near.entries)
      if (distance(point, local) <= tolerance_) pieces.push_back(piece);
    return pieces;
  }

  /// Whether all that a point lies `on` is joined to the triangle's piece, which is the nearest of the others.
  [[nodiscard]] bool is_between(const Vec3& point, const PartTriangle& triangle, const std::vector<Sheets::Link>& links,
                                const NearTriangles& near, const std::vector<std::uint32_t>& on) const {
    const auto is_linked = [&](std::uint32_t piece) {
      return std::any_of(links.begin(), links.end(), [&](const auto& link) { return link.piece == piece; });
    };
    if (on.empty() || !std::all_of(on.begin(), on.end(), is_linked)) return false;
    constexpr double kNearer = 1 - 0x1p-20;
    const double own = kNearer * distance(point, triangle.local);
    return own > tolerance_ && std::none_of(near.entries.begin(), near.entries.end(), [&](const auto& entry) {
             return distance(point, entry.local) < own && std::find(on.begin(), on.end(), entry.piece) == on.end();
           });
  }

  /// Whether some of the points that are tried is seen from the triangle.
  [[nodiscard]] bool goes_on(const Polygon& piece, const PartTriangle& triangle) const {
    return some_point(piece, [&](const Vec3& point) { return is_seen(point, triangle); });
  }

  template <class Is>
  static bool some_point(const Polygon& piece, const Is& is) {
    const Vec3 middle = piece.middle();
    if (is(middle)) return true;
    return std::any_of(piece.begin(), piece.end(), [&](const Vec3& vertex) {
      // Close to where the piece leaves the triangle other faces are the farthest away.
      constexpr std::array kShares{0.0, 0x1p-6, 0x1p-3, 0x1p-1};
      return std::any_of(kShares.begin(), kShares.end(),
                         [&](double share) { return is(vertex + share * (middle - vertex)); });
    });
  }

  static constexpr double kFarthest = std::numeric_limits<double>::infinity();

  const solid::Body &a_, &b_;
  double tolerance_;
  LocalFrame frame_;
};

/// Around which triangles of some sheets the surface is bent; looked up once. Elsewhere what goes on beyond an edge is
/// over one of the triangles there, as wide as they are taken: a bend of 2^-6 makes room for 1/16 of the tolerance in
/// four.
class Bends {
 public:
  explicit Bends(const Sheets& sheets) : bent_(sheets.ids.size()) {}
  bool operator()(std::uint32_t index, const PartTriangle& triangle) {
    if (!bent_[index]) bent_[index] = is_bent_around(triangle);
    return *bent_[index];
  }

 private:
  std::vector<std::optional<bool>> bent_;
};

/// Which triangles of some sheets are small beside the tolerance: pairs of them are open as well.
std::vector<bool> small_ones(const solid::Part& part, const Sheets& sheets, double tolerance) {
  std::vector<bool> small;
  for (const std::uint32_t id : sheets.ids) small.push_back(is_small(part.body.triangle(id), tolerance));
  return small;
}

bool branches(const Sheets& sheets) {
  return std::any_of(sheets.links.begin(), sheets.links.end(), [](const auto& links) { return !links.empty(); });
}

/// Every near pair, those that the encounter left out too.
void each_near(const LinkedPart& a, const LinkedPart& b, double tolerance, const Encounter& encounter,
               const measure::TakePair& take, const std::stop_token& stop) {
  if (!encounter.is_whole) return measure::near_pairs(a.part.body.placed, b.part.body.placed, tolerance, take, stop);
  for (const TrianglePair& pair : encounter.near)
    if (stop.stop_requested() || !take(pair)) return;
}

}  // namespace

bool pass_widely(const LinkedPart& a, const LinkedPart& b, double tolerance, const Encounter& encounter,
                 std::span<const TrianglePair> open, const std::stop_token& stop) {
  if (open.empty() && !encounter.leaves_out_small) return false;
  const Sheets of_a = sheets_of(a.part, encounter.near_a), of_b = sheets_of(b.part, encounter.near_b);
  const auto count_a = static_cast<std::uint32_t>(of_a.ids.size());
  const std::vector<bool> small_a = small_ones(a.part, of_a, tolerance), small_b = small_ones(b.part, of_b, tolerance);
  const auto is_proper = [&](const TrianglePair& pair) {
    return a.part.is_boundary(pair.a) && b.part.is_boundary(pair.b);
  };
  DisjointSets groups(of_a.ids.size() + of_b.ids.size());
  std::vector<bool> is_open(of_a.ids.size());  // by a triangle of a in an open pair
  for (const TrianglePair& pair : open) is_open[of_a.index(pair.a)] = true;
  const auto join = [&](const TrianglePair& pair) {
    if (!is_proper(pair)) return true;
    const std::uint32_t i = of_a.index(pair.a), j = of_b.index(pair.b);
    groups.join(i, count_a + j);
    if (small_a[i] && small_b[j]) is_open[i] = true;
    return true;
  };
  each_near(a, b, tolerance, encounter, join, stop);

  const Passing passing(a, b, tolerance);
  std::vector<bool> is_asked(of_a.ids.size());  // a group is named by its lowest member, of a
  for (std::uint32_t i = 0; i < count_a; ++i)
    if (is_open[i]) is_asked[groups.find(i)] = true;
  Bends bent_a(of_a), bent_b(of_b);
  std::vector<NearTriangles> near_a(branches(of_b) ? of_a.ids.size() : 0);  ///< what b has near each of a's
  std::vector<NearTriangles> near_b(branches(of_a) ? of_b.ids.size() : 0);
  std::vector<bool> lain_a(of_a.ids.size()), lain_b(of_b.ids.size());  ///< pieces along which the other part lies
  const auto each_asked = [&](const auto& take) {
    const auto take_asked = [&](const TrianglePair& pair) {
      const std::uint32_t i = of_a.index(pair.a), j = of_b.index(pair.b);
      return !is_proper(pair) || !is_asked[groups.find(i)] || take(pair, i, j);
    };
    each_near(a, b, tolerance, encounter, take_asked, stop);
  };
  if (!near_a.empty() || !near_b.empty()) {
    each_asked([&](const TrianglePair& pair, std::uint32_t i, std::uint32_t j) {
      if (passing.lie_along(passing.triangle(a, pair.a).local, passing.triangle(b, pair.b).local))
        lain_a[of_a.piece[i]] = lain_b[of_b.piece[j]] = true;
      if (!near_a.empty()) near_a[i].note(of_b.piece[j]);
      if (!near_b.empty()) near_b[j].note(of_a.piece[i]);
      return true;
    });
    std::size_t left = kMostNearBranches;
    each_asked([&](const TrianglePair& pair, std::uint32_t i, std::uint32_t j) {
      if (!near_a.empty() && near_a[i].has_several)
        near_a[i].entries.push_back({passing.triangle(b, pair.b).local, of_b.piece[j]}), --left;
      if (left > 0 && !near_b.empty() && near_b[j].has_several)
        near_b[j].entries.push_back({passing.triangle(a, pair.a).local, of_a.piece[i]}), --left;
      return left > 0;
    });
    if (left == 0) near_a.clear(), near_b.clear();
  }
  std::map<std::array<std::uint32_t, 3>, Place> places;
  bool pass = false;
  each_asked([&](const TrianglePair& pair, std::uint32_t i, std::uint32_t j) {
    Place& place = places[{groups.find(i), of_a.cluster[i], of_b.cluster[j]}];
    const PartTriangle of_pair_a = passing.triangle(a, pair.a), of_pair_b = passing.triangle(b, pair.b);
    const std::uint8_t known_a = place.b_at_a.from(of_a, i), known_b = place.a_at_b.from(of_b, j);
    place.b_at_a.add(of_a, i, passing.see(of_pair_b.local, of_pair_a, bent_a(i, of_pair_a), known_a, place.box));
    place.a_at_b.add(of_b, j, passing.see(of_pair_a.local, of_pair_b, bent_b(j, of_pair_b), known_b, place.box));
    if (!near_b.empty() && near_b[j].has_several)
      passing.see_along(of_pair_b.local, of_pair_a, i, of_a, near_b[j], lain_a, place.b_at_a);
    if (!near_a.empty() && near_a[i].has_several)
      passing.see_along(of_pair_a.local, of_pair_b, j, of_b, near_a[i], lain_b, place.a_at_b);
    pass = place.a_at_b.has_both() && place.b_at_a.has_both() && passing.is_long(place.box);
    return !pass;
  });
  return pass;
}

}  // namespace impinge::clash
