// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "impinge/mesh.hpp"

/// Arithmetic of points for pictures and places: for the eye, not for an answer.
namespace impinge::report {

inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(double s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Point& a) { return std::hypot(a.x, a.y, a.z); }
/// The zero vector stays what it is.
inline Point unit(const Point& a) {
  const double l = length(a);
  return l > 0 ? Point{a.x / l, a.y / l, a.z / l} : a;
}
/// Halved before they are added: neither overflows.
inline Point middle(const Point& a, const Point& b) { return 0.5 * a + 0.5 * b; }

/// An axis-parallel box that grows.
struct Bounds {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  Point lo{kFar, kFar, kFar}, hi{-kFar, -kFar, -kFar};

  void add(const Point& p) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  [[nodiscard]] bool is_empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
};
/// Empty where they have nothing in common.
inline Bounds shared(const Bounds& a, const Bounds& b) {
  return {{std::max(a.lo.x, b.lo.x), std::max(a.lo.y, b.lo.y), std::max(a.lo.z, b.lo.z)},
          {std::min(a.hi.x, b.hi.x), std::min(a.hi.y, b.hi.y), std::min(a.hi.z, b.hi.z)}};
}

}  // namespace impinge::report
