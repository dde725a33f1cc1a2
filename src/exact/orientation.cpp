// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/orientation.hpp"

#include <algorithm>
#include <optional>

#include "core/pose.hpp"
#include "exact/expansion.hpp"
#include "exact/filter.hpp"
#include "exact/integers.hpp"
#include "exact/rational.hpp"

namespace impinge::exact {
namespace {

using ExactVector = std::array<Expansion<2>, 3>;
using ExactNormal = std::array<Expansion<16>, 3>;

ExactVector difference(const Vec3& from, const Vec3& to) {
  return {expansion(two_difference(to.x, from.x)), expansion(two_difference(to.y, from.y)),
          expansion(two_difference(to.z, from.z))};
}

ExactNormal cross(const ExactVector& u, const ExactVector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

ExactNormal normal(const Vec3& a, const Vec3& b, const Vec3& c) { return cross(difference(a, b), difference(a, c)); }

int sign_of_dot(const ExactVector& w, const ExactNormal& n) { return (n[0] * w[0] + n[1] * w[1] + n[2] * w[2]).sign(); }

/// The points as integers in the unit of the lowest bit of them all, of any length: outside of the range in which
/// expansions neither over- nor underflow.
template <std::size_t N>
std::optional<std::array<std::array<Integer, 3>, N>> long_integers(const std::array<Vec3, N>& points) {
  if (std::all_of(points.begin(), points.end(), [](const Vec3& p) { return in_exact_domain(p); })) return std::nullopt;
  const int unit = lowest_bit_of(points, 0);
  std::array<std::array<Integer, 3>, N> integers;
  for (std::size_t i = 0; i < N; ++i)
    integers[i] = {integer(points[i].x, unit), integer(points[i].y, unit), integer(points[i].z, unit)};
  return integers;
}

/// Sign of det(b - a, c - a, to - from).
int sign_of(const std::array<std::array<Integer, 3>, 5>& p) {
  const auto u = [&](std::size_t i) { return Integer(p[1][i] - p[0][i]); };
  const auto v = [&](std::size_t i) { return Integer(p[2][i] - p[0][i]); };
  const auto w = [&](std::size_t i) { return Integer(p[4][i] - p[3][i]); };
  Integer sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum += w(i) * Integer(u(j) * v(k) - u(k) * v(j));
  }
  return sum.sign();
}

int orient2d_by_expansions(double ax, double ay, double bx, double by, double cx, double cy) {
  const Expansion<8> left = expansion(two_difference(ax, cx)) * expansion(two_difference(by, cy));
  const Expansion<8> right = expansion(two_difference(ay, cy)) * expansion(two_difference(bx, cx));
  return (left - right).sign();
}

}  // namespace

int orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const int sign = filtered_orient2d(ax, ay, bx, by, cx, cy);
  if (sign != kUnsure) return sign;
  std::array<IntVec, 3> p;
  if (to_integers(std::array{Vec3{ax, ay, 0}, Vec3{bx, by, 0}, Vec3{cx, cy, 0}}, p.data()))
    return orient2d(p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y);
  if (const auto p_long = long_integers(std::array{Vec3{ax, ay, 0}, Vec3{bx, by, 0}, Vec3{cx, cy, 0}})) {
    const auto& [a, b, c] = *p_long;
    return Integer((a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0])).sign();
  }
  return orient2d_by_expansions(ax, ay, bx, by, cx, cy);
}

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int sign = filtered_orient3d(a, b, c, d);
  if (sign != kUnsure) return sign;
  std::array<IntVec, 4> p;
  if (to_integers(std::array{a, b, c, d}, p.data())) return orient3d(p[0], p[1], p[2], p[3]);
  if (const auto p_long = long_integers(std::array{a, b, c, a, d})) return sign_of(*p_long);
  return sign_of_dot(difference(a, d), normal(a, b, c));
}

int Plane::side(const Vec3& d) {
  const int sign = filtered_orient3d(a_, b_, c_, d);
  if (sign != kUnsure) return sign;
  if (const auto p_long = long_integers(std::array{a_, b_, c_, a_, d})) return sign_of(*p_long);
  if (!normal_) normal_ = normal(a_, b_, c_);
  return sign_of_dot(difference(a_, d), *normal_);
}

int side_of_step(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& from, const Vec3& to) {
  const int sign = FilteredNormal(b - a, c - a).sign(to - from);
  if (sign != kUnsure) return sign;
  std::array<IntVec, 5> p;
  if (to_integers(std::array{a, b, c, from, to}, p.data()))
    return sign_of_dot(p[4] - p[3], cross(p[1] - p[0], p[2] - p[0]));
  if (const auto p_long = long_integers(std::array{a, b, c, from, to})) return sign_of(*p_long);
  return sign_of_dot(difference(from, to), normal(a, b, c));
}

}  // namespace impinge::exact
