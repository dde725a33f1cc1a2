// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/locate.hpp"

#include "solid/point_signs.hpp"
#include "solid/ray_walk.hpp"

namespace impinge::solid {
namespace {

constexpr exact::Projection kAlongRay = exact::kProjections[0];

int sign(double from, double to) { return to < from ? -1 : int{to > from}; }

/// orient2d(u, v, p') of p' = p + (e, e²), the ray's way through the plane of y and z: of p or, where that is 0, of the
/// derivative by p.y, then by p.z. 0 only where u and v are one point there, so that their triangle is a segment.
template <class PointSigns>
int turn_beside(const PointSigns& p, const Vec3& u, const Vec3& v) {
  if (const int turn = p.turn(kAlongRay, u, v); turn != 0) return turn;
  const int by_y = sign(v.z, u.z);
  return by_y != 0 ? by_y : sign(u.y, v.y);
}

/// Whether the triangle's box shows that the ray may meet it, or p lie on it. Only compares coordinates.
template <class PointSigns>
bool on_the_way(const PointSigns& p, const Triangle& t) {
  const auto spans = [&](int axis) {
    int below = 0, above = 0;
    for (const Vec3& v : t) {
      const int where = p.sign_of_difference(component(v, axis), axis);
      below += int{where <= 0}, above += int{where >= 0};
    }
    return below != 0 && above != 0;
  };
  const auto reaches = [&] {
    for (const Vec3& v : t)
      if (p.sign_of_difference(v.x, 0) >= 0) return true;
    return false;
  };
  return spans(1) && spans(2) && reaches();
}

/// How the ray from p' = p + (e³, e, e²) crosses the triangle: +1 out of its front, -1 into it, 0 not at all. If p',
/// projected along x, is in the projected triangle, it is in its interior and the triangle is proper: the ray crosses
/// it if p' is behind the plane in the direction of the ray. If p is in the plane, it lies on the closed triangle, as
/// the limit of p'; then the side of p' follows from the rule.
template <class PointSigns>
int crossing(const PointSigns& p, const Triangle& t) {
  const int first = turn_beside(p, t[0], t[1]);
  if (first == 0 || turn_beside(p, t[1], t[2]) != first || turn_beside(p, t[2], t[0]) != first) return 0;
  const int side = p.side(t);
  return (side != 0 ? side : side_beside(t)) == -first ? first : 0;
}

/// Collects the triangles that hold p, and calls take(triangle, way) for each that the ray crosses.
template <class PointSigns, class Take>
void walk_crossings(const hierarchy::PlacedTree& body, const PointSigns& p, std::vector<std::uint32_t>& holders,
                    const Take& take) {
  walk_ray(body, p.near(), [&](const Triangle& t, std::uint32_t id) {
    if (!on_the_way(p, t)) return;
    if (lies_on(p, t)) holders.push_back(id);
    if (const int way = crossing(p, t); way != 0) take(id, way);
  });
}

template <class PointSigns>
Around around_point(const hierarchy::PlacedTree& body, const PointSigns& p) {
  Around result{0, {}};
  walk_crossings(body, p, result.holders, [&](std::uint32_t /*id*/, int way) { result.beside += way; });
  return result;
}

}  // namespace

int side_beside(const Triangle& t) {
  for (const int axis : {1, 2, 0})
    if (const int normal = exact::orient2d(exact::kProjections[static_cast<std::size_t>(axis)], t[0], t[1], t[2]);
        normal != 0)
      return normal;
  return 0;
}

Crossings crossings_around(const hierarchy::PlacedTree& body, const Vec3& point) {
  Crossings result;
  walk_crossings(body, DoublePoint(point), result.holders, [&](std::uint32_t id, int way) {
    result.crossings.push_back({id, way});
  });
  return result;
}

Around around(const hierarchy::PlacedTree& body, const Vec3& point) { return around_point(body, DoublePoint(point)); }

Around around(const hierarchy::PlacedTree& body, const exact::RationalPoint& point) {
  const RationalPointSigns signs(point);
  return signs.is_double() ? around(body, signs.near()) : around_point(body, signs);
}

std::optional<int> winding_number(const hierarchy::PlacedTree& body, const Vec3& point) {
  const Around found = around(body, point);
  return found.holders.empty() ? std::optional(found.beside) : std::nullopt;
}

}  // namespace impinge::solid
