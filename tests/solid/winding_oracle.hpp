// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "tests/oracle/rational.hpp"

/// Winding numbers in rational numbers, along rays in random directions, drawn anew until one meets no edge: no ties,
/// so none to break.
namespace oracle {

using Triangles = std::vector<std::array<Vec, 3>>;

inline int sign_of_volume(const Vec& u, const Vec& v, const Vec& w) { return sgn(dot(u, cross(v, w))); }

inline bool holds(const std::array<Vec, 3>& triangle, const Vec& p) {
  const auto& [a, b, c] = triangle;
  for (std::size_t k = 0; k < 3; ++k)
    if ((p[k] < a[k] && p[k] < b[k] && p[k] < c[k]) || (p[k] > a[k] && p[k] > b[k] && p[k] > c[k])) return false;
  return !common_part({p}, half_spaces(simplified({triangle[0], triangle[1], triangle[2]}))).empty();
}

/// How often the ray crosses the triangle, +1 out of its front; nothing where it meets an edge or runs in the plane.
inline std::optional<int> crossing(const std::array<Vec, 3>& t, const Vec& p, const Vec& direction) {
  const Vec a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const Vec normal = cross(t[1] - t[0], t[2] - t[0]);
  if (is_zero(normal)) return 0;
  const int ab = sign_of_volume(direction, a, b), bc = sign_of_volume(direction, b, c);
  const int ca = sign_of_volume(direction, c, a);
  if ((ab > 0 || bc > 0 || ca > 0) && (ab < 0 || bc < 0 || ca < 0)) return 0;
  if (ab == 0 || bc == 0 || ca == 0) return std::nullopt;
  // The plane is met at p + s direction with s (normal . direction) = normal . a.
  const int toward = sgn(dot(normal, direction)), height = sgn(dot(normal, a));
  return toward * height > 0 ? toward : 0;
}

/// Nothing if a triangle holds p. `draw` gives random integers.
template <class Draw>
std::optional<int> winding_number(const Triangles& triangles, const Vec& p, const Draw& draw) {
  for (const auto& triangle : triangles)
    if (holds(triangle, p)) return std::nullopt;
  for (;;) {
    const Vec direction = vec(draw(), draw(), draw());
    int winding = 0;
    bool generic = true;
    for (const auto& triangle : triangles) {
      const std::optional<int> met = crossing(triangle, p, direction);
      generic &= met.has_value();
      winding += met.value_or(0);
    }
    if (generic) return winding;
  }
}

}  // namespace oracle
