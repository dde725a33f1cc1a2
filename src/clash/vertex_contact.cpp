// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/vertex_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace impinge::clash {
namespace {

/// The directions of a triangle's two edges from a corner, and that of their bisector.
struct Wedge {
  Vec3 first, second, middle;
  bool is_proper;

  Wedge(const Triangle& t, std::size_t corner) {
    const Vec3 e = t[(corner + 1) % 3] - t[corner], f = t[(corner + 2) % 3] - t[corner];
    const double length_e = norm(e), length_f = norm(f);
    is_proper = length_e > 0 && length_f > 0;
    if (!is_proper) return;
    first = (1 / length_e) * e, second = (1 / length_f) * f, middle = first + second;
    const double length = norm(middle);
    if (length > 0) middle = (1 / length) * middle;
  }
};

}  // namespace

// Let v and w be the corners, e and f the edges from v, and n a direction in which e and f rise by at least the sine c
// while both of b's edges from w fall. A common point is v + p e + q f with p, q >= 0, and as far along n as some point
// of b, which is no farther than w: so p |e| + q |f| <= |w - v| / c, and the point is no farther from v than that. With
// c >= 8 |w - v| / tolerance, doubled for rounding, that is an eighth of the tolerance; with v = w it is 0. The same
// holds of w. Differences of corners are good to 2^-53 in each coordinate, and no product of two over- or underflows
// (contract 1.3), so that computed sines are off by less than 2^-49.
std::optional<VertexContact> find_vertex_contact(const Triangle& a, const Triangle& b, double tolerance) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t i = 0, j = 0;
  for (std::size_t k = 0; k < 9; ++k) {
    const Vec3 gap = b[k % 3] - a[k / 3];
    const double square = dot(gap, gap);
    if (square < least) least = square, i = k / 3, j = k % 3;
  }
  const double gap = std::sqrt(least);
  if (gap > tolerance / 4) return std::nullopt;
  const double least_sine = gap == 0 ? 0x1p-40 : std::max(0x1p-40, 16 * (gap / tolerance));
  const Wedge of_a(a, i), of_b(b, j);
  if (!of_a.is_proper || !of_b.is_proper) return std::nullopt;
  const Vec3 between = of_a.middle - of_b.middle;
  const double length = norm(between);
  if (!(length > 0)) return std::nullopt;
  const Vec3 up = (1 / length) * between;
  if (std::min(dot(up, of_a.first), dot(up, of_a.second)) < least_sine ||
      std::max(dot(up, of_b.first), dot(up, of_b.second)) > -least_sine)
    return std::nullopt;
  return VertexContact{static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), gap == 0};
}

}  // namespace impinge::clash
