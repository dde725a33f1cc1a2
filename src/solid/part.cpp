// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/part.hpp"

#include <algorithm>
#include <utility>

#include "exact/rational.hpp"
#include "exact/triangle_pair.hpp"
#include "solid/locate.hpp"

namespace impinge::solid {
namespace {

/// A point of the open triangle, another one for each number. All but the first lie on a curve that no line meets in
/// more than two points, so that few of them lie on the segments and points in which others touch the triangle.
exact::RationalPoint interior_point(const Triangle& t, int number) {
  const exact::Rational p = 1, q = number + 1, r = number == 0 ? exact::Rational(2) : exact::Rational(q * q);
  const exact::RationalPoint a = exact::rational(t[0]), b = exact::rational(t[1]), c = exact::rational(t[2]);
  exact::RationalPoint point;
  for (std::size_t i = 0; i < 3; ++i) point[i] = (p * a[i] + q * b[i] + r * c[i]) / (p + q + r);
  return point;
}

/// In front of a triangle the surface winds around points once less than behind it. The point beside one that no other
/// proper triangle holds sees one of the two.
Part::Sides sides_of(const Body& body, const Topology& topology, std::uint32_t triangle) {
  const Triangle t = body.triangle(triangle);
  for (int number = 0;; ++number) {
    const Around found = around(body.placed, interior_point(t, number));
    const auto is_other = [&](std::uint32_t i) { return i != triangle && topology.is_proper(i); };
    const auto covers = [&](std::uint32_t i) { return is_other(i) && exact::share_area(t, body.triangle(i)); };
    // No solid has triangles that cover others; were there one, no point would do.
    const bool covered = std::any_of(found.holders.begin(), found.holders.end(), covers);
    if (!covered && std::any_of(found.holders.begin(), found.holders.end(), is_other)) continue;
    const int front = side_beside(t) > 0 ? found.beside : found.beside - 1;
    return {front != 0, front + 1 != 0};
  }
}

}  // namespace

Part make_part(Body body, Topology topology, bool solid) {
  Part part{std::move(body), std::move(topology), solid, {}};
  if (!solid) return part;
  for (std::uint32_t t = 0; t < part.body.size(); ++t)  // shells are numbered by their first triangles
    if (part.topology.shell[t] == part.sides.size()) part.sides.push_back(sides_of(part.body, part.topology, t));
  return part;
}

}  // namespace impinge::solid
