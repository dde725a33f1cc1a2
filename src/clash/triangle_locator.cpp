// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/triangle_locator.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "measure/triangle_distance.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

using solid::kInside;
using solid::kNear;
using solid::kOutside;

/// Pieces with a radius of at most so many tolerances are halved until they are small, rather than cut by many slabs.
constexpr double kHalved = 32;
/// A triangle within this share of the tolerance of a point leaves room for the piece around it; where there is none,
/// the nearest triangle is taken.
constexpr double kNotTooNear = 0.75;

double radius(const Polygon& piece, const Vec3& middle) {
  double most = 0;
  for (const Vec3& point : piece) most = std::max(most, norm(point - middle));
  return most;
}

}  // namespace

std::uint8_t locate(const solid::Part& part, const Vec3& point) {
  if (!part.solid || !overlap(part.body.box, {point, point})) return kOutside;
  const auto winding = solid::winding_number(part.body.placed, point);
  return !winding ? kNear : *winding != 0 ? kInside : kOutside;
}

std::optional<std::uint8_t> TriangleLocator::look_at(const Triangle& triangle, std::span<const TrianglePair> near,
                                                     const std::array<bool, 3>& corners) {
  bits_ = 0, effort_ = 0;
  slabs_.clear();
  const Triangle own = space_.frame.to_local(triangle);
  const Polygon whole(own);
  if (radius(whole, whole.middle()) <= kSmall * tolerance_) {
    settle(whole);
  } else {
    if (!make_slabs(own, near, corners)) return std::nullopt;
    SlabIds all(slabs_.size());
    std::iota(all.begin(), all.end(), 0u);
    divide(whole, all, {all.size(), 0});
  }
  return is_exhausted() ? std::nullopt : std::optional(bits_);
}

// A triangle takes a step for each slab and piece, or for each two slabs that overlap. Many more steps mean that
// rounding keeps the search from ending.
bool TriangleLocator::is_exhausted() const {
  return effort_ > (1 << 17) + 64 * slabs_.size() * slabs_.size() || space_.stop.stop_requested();
}

// Makes the slabs that reach one triangle. The rest of the triangle, outside of all slabs, meets no triangle of the
// other part.
bool TriangleLocator::make_slabs(const Triangle& own, std::span<const TrianglePair> near,
                                 const std::array<bool, 3>& corners) {
  for (const TrianglePair& pair : near) {
    const Triangle triangle = space_.frame.to_local(other_.body.triangle(pair.b));
    const auto slab = make_slab(triangle, tolerance_, space_.frame.scale);
    if (!slab) return false;
    slabs_.push_back({*slab, triangle});
  }
  for (std::size_t corner = 0; corner < 3; ++corner)
    if (corners[corner]) slabs_.push_back({make_corner_slab(own[corner], tolerance_), std::nullopt});
  return true;
}

// Halves a piece until few slabs reach it, or until halving no longer separates slabs that overlap.
void TriangleLocator::divide(const Polygon& piece, const SlabIds& slabs, Before before) {
  constexpr std::size_t kFew = 8;
  constexpr int kPatience = 3;
  ++effort_;
  if (is_exhausted()) return;
  if (slabs.empty()) {
    locate_at(piece.middle());
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

// Subtracts the slabs from a piece and evaluates the rest: each part that a side of a slab cuts off goes on alone.
void TriangleLocator::subtract(Polygon piece, const SlabIds& slabs, std::size_t next) {
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
  if (next == slabs.size()) return evaluate(piece, slabs);
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

// Locates a piece whose far points, those farther than the tolerance from the other boundary, are all on one side of
// it. The piece is near if all of it is near one triangle, and located by any far point that is found; otherwise it is
// halved. A tiny piece without a far point is near: a point of it that is farther is so by rounding alone.
void TriangleLocator::evaluate(const Polygon& piece, const SlabIds& slabs) {
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
  const auto by_middle = nearest(middle, kNotTooNear * space_.tolerance);
  if (!by_middle) {
    locate_at(middle);
    return;
  }
  const double least = std::max(0x1p-20 * tolerance_, 0x1p-47 * space_.frame.scale);
  if (is_near(piece, by_middle->triangle) || radius(piece, middle) <= least) {
    bits_ |= kNear;
    return;
  }
  if (is_told_by_corners(piece)) return;
  const Cut halves = halve(piece);
  for (const Polygon* half : {&halves.within, &halves.beyond})
    if (half->size() > 0) evaluate(*half, slabs);
}

// Locates a piece that is small beside the tolerance without slabs: halves it until each half is located.
void TriangleLocator::settle(const Polygon& piece) {
  constexpr double kSmallest = 0x1p-4;
  ++effort_;
  if (is_exhausted()) return;
  const Vec3 middle = piece.middle();
  const double size = radius(piece, middle);
  if (size <= kSmallest * tolerance_) return evaluate(piece, {});
  if (is_told(piece, middle, size)) return;
  const Cut halves = halve(piece);
  for (const Polygon* half : {&halves.within, &halves.beyond})
    if (half->size() > 0) settle(*half);
}

// The distances of two points from a boundary differ by no more than the distance between them. If the middle of a
// piece of radius r has the distance d, all of the piece is near where d + r <= t, and far, on one side, where d - r >
// t. The segment between two points on different sides meets the boundary: if both are farther than t from it, they are
// more than 2 t apart. So all far points within 2 t of a far point are on its side, whatever lies between.
//
// Points are off by a few roundings of the largest coordinate for each time that their piece was halved: less than
// the slack, which is 2^-11 t at most. A point is far here if it is not certainly near, in a distance of more than
// (1 - 2^-10) t: 1.5 t stand for 2 t.
bool TriangleLocator::is_told(const Polygon& piece, const Vec3& middle, double size) {
  const double reach = size * (1 + 0x1p-40) + 0x1p-47 * space_.frame.scale;
  const Vec3 world = space_.frame.to_world(middle);
  const double within = (tolerance_ + reach) / space_.frame.unit;
  const double enough = std::max(most_ - reach, 0.0) / space_.frame.unit;
  const auto found = measure::nearest_point(other_.body.placed, world, within, enough, space_.stop);
  if (!found) return bits_ |= locate(other_, world), true;
  const double farthest = space_.frame.unit * (found->distance + found->error);
  if (farthest + reach <= most_ || is_near(piece, found->triangle)) return bits_ |= kNear, true;
  if (farthest > most_) {
    const bool is_all = reach <= 1.5 * tolerance_;
    if (is_all) bits_ |= locate(other_, world);
    return is_all;
  }
  if (2 * reach > 1.5 * tolerance_) return false;
  return is_told_by_corners(piece);
}

// A point of the piece farthest from a triangle is one of its vertices, since distance from a convex set is convex.
bool TriangleLocator::is_near(const Polygon& piece, const Triangle& triangle) const {
  return std::all_of(piece.begin(), piece.end(), [&](const Vec3& p) {
    const auto found = measure::point_distance(p, triangle, kInfinity);
    return found.distance + found.margin <= most_;
  });
}

bool TriangleLocator::is_near(const Polygon& piece, std::uint32_t triangle) const {
  return is_near(piece, space_.frame.to_local(other_.body.triangle(triangle)));
}

// The nearest point of the other part, if it is certainly within the tolerance but for the rounding of `point`.
std::optional<measure::NearestPoint> TriangleLocator::nearest(const Vec3& point, double enough) const {
  const Vec3 world = space_.frame.to_world(point);
  const double within = most_ / space_.frame.unit;
  return measure::nearest_point(other_.body.placed, world, within, enough, space_.stop);
}

// Locates a piece whose far points are all on one side if some corner is far, or if the triangle nearest to a corner is
// near to all of the piece. Where faces meet, that need not be the triangle nearest to the middle.
bool TriangleLocator::is_told_by_corners(const Polygon& piece) {
  for (const Vec3& corner : piece) {
    const auto found = nearest(corner, kNotTooNear * space_.tolerance);
    if (!found) return locate_at(corner), true;
    if (is_near(piece, found->triangle)) return bits_ |= kNear, true;
  }
  return false;
}

}  // namespace impinge::clash
