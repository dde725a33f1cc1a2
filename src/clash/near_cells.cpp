// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/near_cells.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>

#include "clash/local_frame.hpp"
#include "clash/slab.hpp"
#include "measure/nearest.hpp"
#include "measure/triangle_distance.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

using solid::kInside;
using solid::kNear;
using solid::kOutside;

constexpr double kFar = std::numeric_limits<double>::infinity();

bool has_inner_shells(const solid::Part& part) {
  return std::any_of(part.sides.begin(), part.sides.end(), [](const auto& side) { return side.front == side.back; });
}

struct Setting {
  LocalFrame frame;
  double tolerance;  ///< in the world
  const std::stop_token& stop;
};

/// One part's boundary against the other's.
class OneSide {
 public:
  OneSide(const LinkedPart& own, const LinkedPart& other, const Setting& setting, std::vector<TrianglePair> near,
          const LeftOut& left_out)
      : own_(own), other_(other.part), setting_(setting), near_(std::move(near)), left_out_(left_out) {
    for (const TrianglePair& pair : near_)
      if (near_triangles_.empty() || near_triangles_.back() != pair.a) near_triangles_.push_back(pair.a);
  }

  /// The bits of what has no near triangle of the other's: shells, and the rims of what is left of those that have.
  std::uint8_t look_at_clear() {
    std::vector<bool> is_met(own_.part.topology.shells, false);
    std::uint32_t unmet = own_.part.topology.shells;
    const auto meet = [&](std::uint32_t t) {
      const std::uint32_t shell = shell_of(t);
      const bool is_first = shell != solid::Topology::kNoShell && !is_met[shell];
      if (is_first) is_met[shell] = true, --unmet;
      return is_first;
    };
    for (const std::uint32_t t : near_triangles_) meet(t);
    std::uint8_t bits = 0;
    const auto& triangles = own_.part.body.placed.mesh->triangles;
    for (std::uint32_t t = 0; unmet > 0; ++t)
      if (meet(t)) bits |= locate(own_.part.body.world[triangles[t][0]]);
    for (std::uint32_t t = 0; has_degenerate_cells() && t < triangles.size(); ++t)
      if (shell_of(t) == solid::Topology::kNoShell && !is_near(t))
        bits |= locate(own_.part.body.world[triangles[t][0]]);
    return bits | look_at_rims();
  }

  /// The bits of the near triangles, cut into pieces; `so_far` is told of each triangle's, and ends it by true. False
  /// if some could not be told.
  template <class SoFar>
  bool look_at_near(const SoFar& so_far) {
    std::size_t first = 0;
    while (first < near_.size()) {
      std::size_t last = first;
      while (last < near_.size() && near_[last].a == near_[first].a) ++last;
      if (counts(near_[first].a)) {
        bits_ = 0, effort_ = 0;
        if (!look_at(std::span(near_).subspan(first, last - first)) || is_exhausted()) return false;
        if (so_far(bits_)) return true;
      }
      first = last;
    }
    return true;
  }

 private:
  /// Of a triangle; or of a corner, about which lie those that were left out.
  struct NearSlab {
    Slab slab;
    std::optional<Triangle> triangle;
  };

  /// In tolerances: pieces of at most this radius are told by distances alone, without slabs; and those of at most that
  /// are halved until they are, rather than cut by a great many slabs.
  static constexpr double kSmall = 4, kHalved = 32;
  /// Of the tolerance: a triangle so near leaves room for the piece itself; where none is, the nearest is the best.
  static constexpr double kNotTooNear = 0.75;

  /// One triangle, with all that is near it.
  bool look_at(std::span<const TrianglePair> near) {
    slabs_.clear();
    const Polygon whole(setting_.frame.to_local(own_.part.body.triangle(near[0].a)));
    if (radius(whole, whole.middle()) <= kSmall * tolerance_) return settle(whole), true;
    if (!make_slabs(near)) return false;
    std::vector<std::uint32_t> all(slabs_.size());
    std::iota(all.begin(), all.end(), 0u);
    divide(whole, all, {all.size(), 0});
    return true;
  }

  /// Those that reach one triangle. What is left of it outside of them all meets nothing of the other part.
  bool make_slabs(std::span<const TrianglePair> near) {
    for (const TrianglePair& pair : near) {
      const Triangle triangle = setting_.frame.to_local(other_.body.triangle(pair.b));
      const auto slab = make_slab(triangle, tolerance_, setting_.frame.scale);
      if (!slab) return false;
      slabs_.push_back({*slab, triangle});
    }
    const Triangle own = setting_.frame.to_local(own_.part.body.triangle(near[0].a));
    for (std::size_t corner = 0; corner < 3; ++corner)
      if (left_out_.at(near[0].a, corner)) slabs_.push_back({make_corner_slab(own[corner], tolerance_), std::nullopt});
    return true;
  }

  [[nodiscard]] std::uint32_t shell_of(std::uint32_t triangle) const { return own_.part.topology.shell[triangle]; }
  /// To a solid's boundary degenerate triangles add nothing; a surface has the segments and points that they are.
  [[nodiscard]] bool has_degenerate_cells() const { return !own_.part.solid && own_.part.topology.degenerate > 0; }
  [[nodiscard]] bool counts(std::uint32_t triangle) const {
    return !own_.part.solid || shell_of(triangle) != solid::Topology::kNoShell;
  }
  [[nodiscard]] bool is_near(std::uint32_t triangle) const {
    return std::binary_search(near_triangles_.begin(), near_triangles_.end(), triangle);
  }

  /// Of a point that is not near the other part.
  [[nodiscard]] std::uint8_t locate(const Vec3& point) const {
    const Box& box = other_.body.box;
    if (!other_.solid || !overlap(box, {point, point})) return kOutside;
    const auto winding = solid::winding_number(other_.body.placed, point);
    return !winding ? kNear : *winding != 0 ? kInside : kOutside;
  }

  std::uint8_t look_at_rims() const {
    std::vector<std::uint32_t> rim;
    const auto& triangles = own_.part.body.placed.mesh->triangles;
    const auto& position = own_.part.topology.position;
    for (const std::uint32_t t : near_triangles_)
      for (const std::uint32_t vertex : triangles[t]) rim.push_back(vertex);
    std::sort(rim.begin(), rim.end(), [&](std::uint32_t v, std::uint32_t w) { return position[v] < position[w]; });
    std::uint8_t bits = 0;
    for (std::size_t i = 0; i < rim.size() && bits != (kInside | kOutside) && !setting_.stop.stop_requested(); ++i) {
      const std::uint32_t at = position[rim[i]];
      if (i > 0 && position[rim[i - 1]] == at) continue;
      const auto fan = own_.fans.triangles.begin();
      const auto begin = fan + own_.fans.offsets[at], end = fan + own_.fans.offsets[at + 1];
      const bool is_clear = std::any_of(begin, end, [&](std::uint32_t t) { return counts(t) && !is_near(t); });
      if (is_clear) bits |= locate(own_.part.body.world[rim[i]]);
    }
    return bits;
  }

  /// A triangle takes a step for each slab and piece, or for each two slabs where they lie over each other; with many
  /// more, floating point got lost.
  [[nodiscard]] bool is_exhausted() const {
    return effort_ > (1 << 17) + 64 * slabs_.size() * slabs_.size() || setting_.stop.stop_requested();
  }

  /// How many slabs reached a piece some halvings ago.
  struct Before {
    std::size_t slabs;
    int halvings;
  };

  /// Halves a piece until few slabs reach it, or halving does not part those that lie over each other.
  void divide(const Polygon& piece, const std::vector<std::uint32_t>& slabs, Before before) {
    constexpr std::size_t kFew = 8;
    constexpr int kPatience = 3;
    ++effort_;
    if (is_exhausted()) return;
    if (slabs.empty()) {
      bits_ |= locate(setting_.frame.to_world(piece.middle()));
      return;
    }
    if (4 * slabs.size() <= 3 * before.slabs) before = {slabs.size(), 0};
    if (slabs.size() <= kFew) return subtract(piece, slabs, 0);
    const double size = radius(piece, piece.middle());
    if (size <= kSmall * tolerance_) return settle(piece);
    if (before.halvings == kPatience && size > kHalved * tolerance_) return subtract(piece, slabs, 0);
    const Cut halves = halve(piece);
    for (const Polygon* half : {&halves.within, &halves.beyond}) {
      if (half->size() == 0) continue;
      Box box{(*half)[0], (*half)[0]};
      for (const Vec3& point : *half) box = {min(box.lo, point), max(box.hi, point)};
      std::vector<std::uint32_t> reaching;
      std::copy_if(slabs.begin(), slabs.end(), std::back_inserter(reaching),
                   [&](std::uint32_t i) { return overlap(slabs_[i].slab.box, box); });
      divide(*half, reaching, {before.slabs, std::min(before.halvings + 1, kPatience)});
    }
  }

  static double radius(const Polygon& piece, const Vec3& middle) {
    double most = 0;
    for (const Vec3& point : piece) most = std::max(most, norm(point - middle));
    return most;
  }

  /// A piece that is small beside the tolerance, whatever slabs reach it: in halves until each is told.
  void settle(const Polygon& piece) {
    constexpr double kSmallest = 0x1p-4;
    ++effort_;
    if (is_exhausted()) return;
    const Vec3 middle = piece.middle();
    const double size = radius(piece, middle);
    if (size <= kSmallest * tolerance_) return evaluate(piece, {}, 0);
    if (is_told(piece, middle, size)) return;
    const Cut halves = halve(piece);
    for (const Polygon* half : {&halves.within, &halves.beyond})
      if (half->size() > 0) settle(*half);
  }

  /// Distances to a boundary differ by no more than their points do. With the middle in the distance d, all of a piece
  /// of radius r is near where d + r <= t, and far, on one side, where d - r > t. And of two points on different sides
  /// the boundary meets the way from one to the other: if both are farther than t from it, they are more than 2 t
  /// apart. So where one point is far, all far ones within 2 t of it are on its side, whatever lies between.
  ///
  /// Points are off by a few roundings of the largest coordinate for each time that their piece was halved: less than
  /// the slack, which is 2^-11 t at most. A point is far here if it is not certainly near, in a distance of more than
  /// (1 - 2^-10) t: 1.5 t stand for 2 t.
  bool is_told(const Polygon& piece, const Vec3& middle, double size) {
    const double reach = size * (1 + 0x1p-40) + 0x1p-47 * setting_.frame.scale;
    const Vec3 world = setting_.frame.to_world(middle);
    const double within = (tolerance_ + reach) / setting_.frame.unit;
    const double enough = std::max(most_ - reach, 0.0) / setting_.frame.unit;
    const auto found = measure::nearest_point(other_.body.placed, world, within, enough, setting_.stop);
    if (!found) return bits_ |= locate(world), true;
    const double farthest = setting_.frame.unit * (found->distance + found->error);
    if (farthest + reach <= most_ || is_near(piece, found->triangle)) return bits_ |= kNear, true;
    if (farthest > most_) {
      const bool is_all = reach <= 1.5 * tolerance_;
      if (is_all) bits_ |= locate(world);
      return is_all;
    }
    if (2 * reach > 1.5 * tolerance_) return false;
    return is_told_by_corners(piece);
  }

  /// What is left of a piece outside of all slabs is evaluated: each part that a slab's side cuts off goes on alone.
  void subtract(Polygon piece, const std::vector<std::uint32_t>& slabs, std::size_t next) {
    ++effort_;
    if (is_exhausted()) return;
    if (piece.is_full()) {  // its halves have fewer vertices: all but two are shared out
      const Cut halves = halve(piece);
      for (const Polygon* half : {&halves.within, &halves.beyond})
        if (half->size() > 0) subtract(*half, slabs, next);
      return;
    }
    const auto misses = [&](const HalfSpace& half_space) {
      return std::all_of(piece.begin(), piece.end(),
                         [&](const Vec3& p) { return dot(half_space.normal, p) > half_space.offset; });
    };
    const auto is_missed = [&](const Slab& slab) {
      return misses(slab.top) || misses(slab.bottom) ||
             std::any_of(slab.sides.begin(), slab.sides.begin() + static_cast<std::ptrdiff_t>(slab.size), misses);
    };
    for (; next < slabs.size() && is_missed(slabs_[slabs[next]].slab); ++next) ++effort_;
    if (next == slabs.size()) return evaluate(piece, slabs, 0);
    const Slab& slab = slabs_[slabs[next]].slab;
    const auto go_on = [&](const HalfSpace& half_space) {
      const Cut parts = cut(piece, half_space);
      if (parts.beyond.size() > 0) subtract(parts.beyond, slabs, next + 1);
      piece = parts.within;
      return piece.size() > 0;
    };
    for (std::size_t i = 0; i < slab.size; ++i)
      if (!go_on(slab.sides[i])) return;
    if (go_on(slab.top) && go_on(slab.bottom)) bits_ |= kNear;
  }

  /// The farthest that the piece's points are from a triangle: at its vertices, for the triangle is convex.
  [[nodiscard]] bool is_near(const Polygon& piece, const Triangle& triangle) const {
    return std::all_of(piece.begin(), piece.end(), [&](const Vec3& p) {
      const auto found = measure::point_distance(p, triangle, kFar);
      return found.distance + found.margin <= most_;
    });
  }

  [[nodiscard]] bool is_near(const Polygon& piece, std::uint32_t triangle) const {
    return is_near(piece, setting_.frame.to_local(other_.body.triangle(triangle)));
  }

  /// Of the other part, certainly within the tolerance but for the roundings of a point.
  [[nodiscard]] std::optional<measure::NearestPoint> nearest(const Vec3& point, double enough) const {
    const Vec3 world = setting_.frame.to_world(point);
    const double within = most_ / setting_.frame.unit;
    return measure::nearest_point(other_.body.placed, world, within, enough, setting_.stop);
  }

  /// Of a piece that is on one side where it is far: whether some corner is far, or what is nearest to it near to all
  /// of the piece. Where faces meet, that need not be what is nearest to the middle.
  bool is_told_by_corners(const Polygon& piece) {
    for (const Vec3& corner : piece) {
      const auto found = nearest(corner, kNotTooNear * setting_.tolerance);
      if (!found) return bits_ |= locate(setting_.frame.to_world(corner)), true;
      if (is_near(piece, found->triangle)) return bits_ |= kNear, true;
    }
    return false;
  }

  /// A piece outside of the slabs, or what is left of it, or a small one, is on one side where it is far: near where
  /// all of it is near one triangle; else some point of it is farther than the tolerance from all, or halving it goes
  /// on.
  void evaluate(const Polygon& piece, const std::vector<std::uint32_t>& slabs, int depth) {
    constexpr int kDeep = 10;
    ++effort_;
    if (is_exhausted()) return;
    const bool is_near_one = std::any_of(slabs.begin(), slabs.end(), [&](std::uint32_t i) {
      return slabs_[i].triangle && is_near(piece, *slabs_[i].triangle);
    });
    if (is_near_one) {
      bits_ |= kNear;
      return;
    }
    const Vec3 middle = piece.middle();
    const auto by_middle = nearest(middle, kNotTooNear * setting_.tolerance);
    if (!by_middle) {
      bits_ |= locate(setting_.frame.to_world(middle));
      return;
    }
    if (is_near(piece, by_middle->triangle)) {
      bits_ |= kNear;
      return;
    }
    if (is_told_by_corners(piece)) return;
    if (depth == kDeep) {
      bits_ |= locate(setting_.frame.to_world(middle));
      return;
    }
    const Cut halves = halve(piece);
    for (const Polygon* half : {&halves.within, &halves.beyond})
      if (half->size() > 0) evaluate(*half, slabs, depth + 1);
  }

  const LinkedPart& own_;
  const solid::Part& other_;
  const Setting& setting_;
  double tolerance_ = setting_.frame.unit * setting_.tolerance;  ///< in local units, as what follows
  double most_ = tolerance_ * (1 - 0x1p-16);                     ///< certainly within the tolerance
  std::vector<TrianglePair> near_;                               ///< own first, sorted
  std::vector<std::uint32_t> near_triangles_;
  const LeftOut& left_out_;
  std::vector<NearSlab> slabs_;  ///< of the triangle at work
  std::uint8_t bits_ = 0;
  std::size_t effort_ = 0;
};

std::vector<TrianglePair> swapped(const std::vector<TrianglePair>& near) {
  std::vector<TrianglePair> result(near.size());
  std::transform(near.begin(), near.end(), result.begin(), [](const TrianglePair& p) {
    return TrianglePair{p.b, p.a};
  });
  std::sort(result.begin(), result.end(), [](const auto& p, const auto& q) { return p.a < q.a; });
  return result;
}

}  // namespace

std::optional<solid::Cells> near_cells(const LinkedPart& a, const LinkedPart& b, const NearSearch& search) {
  if (has_inner_shells(a.part) || has_inner_shells(b.part)) return std::nullopt;
  const LocalFrame frame = local_frame(a.part.body.box, b.part.body.box);
  if (frame.unit * search.tolerance < kLeastTolerance * frame.scale) return std::nullopt;
  const Setting setting{frame, search.tolerance, search.stop};

  const Encounter& met = search.encounter;
  solid::Cells cells;
  OneSide side_a(a, b, setting, met.near, met.of_a), side_b(b, a, setting, swapped(met.near), met.of_b);
  cells.a |= side_a.look_at_clear(), cells.b |= side_b.look_at_clear();
  const auto enough = [&] { return search.enough(cells); };
  if (enough()) return cells;
  const bool told = side_a.look_at_near([&](std::uint8_t bits) { return cells.a |= bits, enough(); }) &&
                    (enough() || side_b.look_at_near([&](std::uint8_t bits) { return cells.b |= bits, enough(); }));
  return told ? std::optional(cells) : std::nullopt;
}

}  // namespace impinge::clash
