// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/vec3.hpp"

/// Signs of determinants by integers. Each axis is scaled by a power of two of its own, which leaves the signs as they
/// are, so that coordinates are integers below 2^60. Differences are then below 2^61, components of their cross
/// products below 2^123 and determinants below 2^186: pairs of words hold all of it without rounding.
namespace impinge::exact {

__extension__ using Int128 = __int128;

struct IntVec {
  std::int64_t x, y, z;
};

struct IntNormal {
  Int128 x, y, z;
};

inline IntVec operator-(const IntVec& a, const IntVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

/// a b - c d, of differences.
inline Int128 minor(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
  return Int128{a} * b - Int128{c} * d;
}

inline IntNormal cross(const IntVec& u, const IntVec& v) {
  return {minor(u.y, v.z, u.z, v.y), minor(u.z, v.x, u.x, v.z), minor(u.x, v.y, u.y, v.x)};
}

/// Sign of w . n. With n = 2^64 high + low, the sums of the products with the highs and with the lows (below 3 2^125)
/// fit into a pair of words each.
inline int sign_of_dot(const IntVec& w, const IntNormal& n) {
  const auto high = [](Int128 x) { return static_cast<std::int64_t>(x >> 64); };
  const auto low = [](Int128 x) { return static_cast<std::uint64_t>(x); };
  const Int128 highs = Int128{w.x} * high(n.x) + Int128{w.y} * high(n.y) + Int128{w.z} * high(n.z);
  const Int128 lows = Int128{w.x} * low(n.x) + Int128{w.y} * low(n.y) + Int128{w.z} * low(n.z);
  const Int128 sum = highs + (lows >> 64);
  if (sum != 0) return sum > 0 ? 1 : -1;
  return low(lows) != 0 ? 1 : 0;
}

struct IntPlane {
  IntVec origin;
  IntNormal normal;
  [[nodiscard]] int side(const IntVec& p) const { return sign_of_dot(p - origin, normal); }
};

inline IntPlane plane_through(const IntVec& a, const IntVec& b, const IntVec& c) { return {a, cross(b - a, c - a)}; }

inline int orient3d(const IntVec& a, const IntVec& b, const IntVec& c, const IntVec& d) {
  return plane_through(a, b, c).side(d);
}

inline int orient2d(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by, std::int64_t cx,
                    std::int64_t cy) {
  const Int128 determinant = minor(ax - cx, by - cy, ay - cy, bx - cx);
  return static_cast<int>(determinant >> 127) | int{determinant != 0};
}

/// False where the points do not fit: where some coordinate has bits too far below those of the largest on its axis.
bool to_integers(std::span<const Vec3> points, IntVec* integers);

}  // namespace impinge::exact
