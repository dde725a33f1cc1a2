// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/far_sides.hpp"

#include <algorithm>
#include <utility>

#include "measure/nearest.hpp"
#include "measure/triangle_distance.hpp"

namespace impinge::clash {
namespace {

constexpr std::uint8_t kBoth = kAbove | kBelow;

Polygon along(const Polygon& piece, const Slab& slab) { return cut(cut(piece, slab.top).within, slab.bottom).within; }

template <class Is>
bool some_point(const Polygon& piece, const Is& is) {
  const Vec3 middle = piece.middle();
  if (is(middle)) return true;
  return std::any_of(piece.begin(), piece.end(), [&](const Vec3& vertex) {
    // Close to where the piece leaves the triangle other faces are the farthest away.
    constexpr std::array kShares{0.0, 0x1p-6, 0x1p-3, 0x1p-1};
    return std::any_of(kShares.begin(), kShares.end(),
                       [&](double share) { return is(vertex + share * (middle - vertex)); });
  });
}

}  // namespace

FarSides::FarSides(const solid::Body& a, const solid::Body& b, double tolerance)
    : tolerance_(tolerance), frame_(local_frame(a.box, b.box)) {}

std::uint8_t FarSides::see(const Triangle& own, const PartTriangle& other, bool is_bent, std::uint8_t known,
                           Box& near) const {
  const auto slab = make_slab(other.local, frame_.unit * tolerance_, frame_.scale);
  if (!slab || !slab->has_plane) return 0;
  const Polygon piece = between(Polygon(own), *slab);
  for (const Vec3& point : along(piece, *slab)) near.lo = min(near.lo, point), near.hi = max(near.hi, point);
  const std::uint8_t found = over(piece, *slab, other, known);
  return is_bent ? found | around(own, *slab, other, known | found) : found;
}

void FarSides::see_along(const Triangle& own, const PartTriangle& other, std::uint32_t index, const Sheets& sheets,
                         const NearTriangles& near, const std::vector<bool>& lain, SidesSeen& seen) const {
  if (lain[sheets.piece[index]]) return;
  const auto slab = make_slab(other.local, frame_.unit * tolerance_, frame_.scale);
  if (!slab || !slab->has_plane) return;
  const Polygon piece = over(between(Polygon(own), *slab), other.local);
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

bool FarSides::lie_along(const Triangle& own, const Triangle& other) const {
  const Vec3 of_own = cross(own[1] - own[0], own[2] - own[0]),
             of_other = cross(other[1] - other[0], other[2] - other[0]);
  if (!(norm(cross(of_own, of_other)) < 0.5 * norm(of_own) * norm(of_other))) return false;
  const auto slab = make_slab(other, frame_.unit * tolerance_, frame_.scale);
  if (!slab || !slab->has_plane) return false;
  const Polygon piece = over(along(Polygon(own), *slab), other);
  double area = 0, outline = 0;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3 &from = piece[i], &to = piece[(i + 1) % piece.size()];
    area += norm(cross(from - piece[0], to - piece[0])) / 2, outline += norm(to - from);
  }
  // Next to each other they have as much in common as triangles are taken wider than they are.
  return area > frame_.unit * tolerance_ / 8 * outline;
}

bool FarSides::is_long(const Box& near) const {
  constexpr double kLong = 16;
  return !is_empty(near) && norm(near.hi - near.lo) > kLong * frame_.unit * tolerance_;
}

Polygon FarSides::over(Polygon piece, const Triangle& other) const {
  const auto sides = sides_of(other);
  for (std::size_t i = 0; i < 3 && piece.size() > 0; ++i) piece = cut(piece, sides[i]).within;
  return piece;
}

/// What goes on over the triangle, however far.
std::uint8_t FarSides::over(Polygon piece, const Slab& slab, const PartTriangle& other, std::uint8_t known) const {
  piece = over(piece, other.local);
  if (piece.size() == 0) return 0;
  const Cut top = cut(piece, slab.top), bottom = cut(piece, slab.bottom);
  std::uint8_t found = 0;
  for (const auto& [side, beyond] : {std::pair(kAbove, &top.beyond), {kBelow, &bottom.beyond}})
    if ((known & side) == 0 && beyond->size() > 0 && goes_on(*beyond, other)) found |= side;
  return found;
}

/// What goes on close to the triangle, but beyond its edges: over none of those that meet there, if it is on the
/// outer side of a fold.
std::uint8_t FarSides::around(const Triangle& own, Slab slab, const PartTriangle& other, std::uint8_t known) const {
  if (known == kBoth) return 0;
  const double wider = 3 * frame_.unit * tolerance_;
  slab.top.offset += wider, slab.bottom.offset += wider;
  for (std::size_t i = 0; i < slab.size; ++i) slab.sides[i].offset += wider;
  const Polygon piece = along(between(Polygon(own), slab), slab);
  if (piece.size() == 0) return 0;
  std::uint8_t found = 0;
  const auto try_at = [&](const Vec3& point) {
    const std::uint8_t side = edge_pseudonormal_side(other, point, frame_.unit * tolerance_);
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
std::array<HalfSpace, 3> FarSides::sides_of(const Triangle& t) const {
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
/// what passes beyond the triangle's end, before another face, is that one's to tell. At an end it is on no side: a
/// wall that runs past a plate's end, flush with it or by less than the tolerance over it, is on both and does not go
/// through.
bool FarSides::is_seen(const Vec3& point, const PartTriangle& triangle) const {
  const auto& body = triangle.part.body.placed;
  const Vec3 world = frame_.to_world(point);
  if (measure::nearest_point(body, world, tolerance_, tolerance_)) return false;
  constexpr double kNearer = 1 - 0x1p-20;
  const double nearer = kNearer * distance(point, triangle.local);
  return !measure::nearest_point(body, world, nearer, nearer) && !is_at_end(point, triangle);
}

/// Whether of the triangle it is where the surface ends, within the tolerance, that is nearest to a point.
bool FarSides::is_at_end(const Vec3& point, const PartTriangle& triangle) const {
  return triangle.ends.are_near(measure::point_distance(point, triangle.local, kInfinity).b, frame_.unit * tolerance_);
}

double FarSides::distance(const Vec3& point, const Triangle& t) const {
  return measure::point_distance(point, t, kInfinity).distance / frame_.unit;
}

/// On which pieces of the other part a point lies, to within the tolerance.
std::vector<std::uint32_t> FarSides::pieces_at(const Vec3& point, const NearTriangles& near) const {
  std::vector<std::uint32_t> pieces;
  for (const auto& [local, piece] : near.entries)
    if (distance(point, local) <= tolerance_) pieces.push_back(piece);
  return pieces;
}

/// Whether all that a point lies `on` is joined to the triangle's piece, which is the nearest of the others. What is
/// at an end of the surface lies on none of it, and next to no side.
bool FarSides::is_between(const Vec3& point, const PartTriangle& triangle, const std::vector<Sheets::Link>& links,
                          const NearTriangles& near, const std::vector<std::uint32_t>& on) const {
  const auto is_linked = [&](std::uint32_t piece) {
    return std::any_of(links.begin(), links.end(), [&](const auto& link) { return link.piece == piece; });
  };
  if (on.empty() || !std::all_of(on.begin(), on.end(), is_linked)) return false;
  constexpr double kNearer = 1 - 0x1p-20;
  const double own = kNearer * distance(point, triangle.local);
  const auto is_nearer = [&](const auto& entry) {
    return distance(point, entry.local) < own && std::find(on.begin(), on.end(), entry.piece) == on.end();
  };
  return own > tolerance_ && std::none_of(near.entries.begin(), near.entries.end(), is_nearer) &&
         !is_at_end(point, triangle) && !triangle.ends.are_near(point, frame_.unit * tolerance_);
}

/// Whether some of the points that are tried is seen from the triangle.
bool FarSides::goes_on(const Polygon& piece, const PartTriangle& triangle) const {
  return some_point(piece, [&](const Vec3& point) { return is_seen(point, triangle); });
}

}  // namespace impinge::clash
