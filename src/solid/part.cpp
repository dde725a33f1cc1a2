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

/// A point in the interior of a triangle, another one for each number. All but the first lie on a curve that no line
/// meets in more than two points, so that few of them lie on the segments and points in which other triangles touch
/// this one.
exact::RationalPoint interior_point(const Triangle& t, int number) {
  const exact::Rational p = 1, q = number + 1, r = number == 0 ? exact::Rational(2) : exact::Rational(q * q);
  const exact::RationalPoint a = exact::rational(t[0]), b = exact::rational(t[1]), c = exact::rational(t[2]);
  exact::RationalPoint point;
  for (std::size_t i = 0; i < 3; ++i) point[i] = (p * a[i] + q * b[i] + r * c[i]) / (p + q + r);
  return point;
}

/// The winding number in front of a triangle is one less than behind it. A point of the triangle that is on no other
/// proper triangle has one of the two beside it.
Part::Sides sides_of(const Body& body, const Topology& topology, std::uint32_t triangle) {
  const Triangle t = body.triangle(triangle);
  for (int number = 0;; ++number) {
    const Around found = around(body.placed, interior_point(t, number));
    const auto is_other = [&](std::uint32_t i) { return i != triangle && topology.is_proper(i); };
    const auto covers = [&](std::uint32_t i) { return is_other(i) && exact::share_area(t, body.triangle(i)); };
    // In a solid no triangle shares an area with another; if one did, the search might not end.
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

Part make_part(Body body) {
  Topology topology = examine(body);
  const bool closed = topology.closed;
  return make_part(std::move(body), std::move(topology), closed);
}

}  // namespace impinge::solid
