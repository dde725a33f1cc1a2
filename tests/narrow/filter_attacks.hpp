// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "impinge/predicates.hpp"
#include "scenes/random.hpp"
#include "tests/core/support.hpp"

/// Attacks on a certified filter at its border: triangles that touch in a point or all but do, stored as far from where
/// they are as the error allows, in the direction that deceives most.
namespace impinge::test::filter {

using scenes::Random;

enum class Said { no, unsure, crossing };

/// Three vertices as a filter is given them, in its type of numbers.
template <class T>
using StoredAs = std::array<std::array<T, 3>, 3>;
using Stored = StoredAs<float>;

template <class T>
struct PairAs {
  StoredAs<T> a, b;
  T error;
};
using Pair = PairAs<float>;

/// The exact triangles, and what is stored of them.
template <class T>
struct AttackAs {
  Triangle a, b;
  PairAs<T> pair;
};
using Attack = AttackAs<float>;

/// `coordinate` moved by up to `shift`, which is at most the error in magnitude, and rounded towards `coordinate`.
template <class T>
T stored(double coordinate, double shift, T error) {
  auto value = static_cast<T>(coordinate + shift);
  for (int i = 0; i < 4 && std::abs(static_cast<long double>(value) - coordinate) > error; ++i)
    value = std::nextafter(value, static_cast<T>(coordinate));
  return value;
}

/// Whether the type can hold the triangle within the error at all.
template <class T>
bool is_within(const Triangle& exact, const StoredAs<T>& s, T error) {
  for (std::size_t v = 0; v < 3; ++v) {
    const std::array<double, 3> x{exact[v].x, exact[v].y, exact[v].z};
    for (std::size_t i = 0; i < 3; ++i)
      if (std::abs(static_cast<long double>(s[v][i]) - x[i]) > error) return false;
  }
  return true;
}

/// By how much to move vertex `v`'s coordinate `i` in units of the error, from -1 to 1.
using Shift = std::function<double(std::size_t v, std::size_t i)>;

template <class T>
StoredAs<T> store(const Triangle& exact, const Shift& shift, T error) {
  StoredAs<T> s;
  for (std::size_t v = 0; v < 3; ++v) {
    const std::array<double, 3> x{exact[v].x, exact[v].y, exact[v].z};
    for (std::size_t i = 0; i < 3; ++i) s[v][i] = stored(x[i], shift(v, i) * error, error);
  }
  return s;
}

/// The stored numbers in several ways: as near as can be; the triangles shifted apart or into each other along each of
/// the cube's diagonals; any corner of what the error allows.
template <class T>
std::vector<AttackAs<T>> attacks_on(const Triangle& a, const Triangle& b, T error, Random& random) {
  std::vector<AttackAs<T>> attacks;
  const auto add = [&](const Shift& of_a, const Shift& of_b) {
    const PairAs<T> pair{store(a, of_a, error), store(b, of_b, error), error};
    if (is_within(a, pair.a, error) && is_within(b, pair.b, error)) attacks.push_back({a, b, pair});
  };
  const auto none = [](std::size_t, std::size_t) { return 0.0; };
  add(none, none);
  if (error == 0) return attacks;
  for (unsigned signs = 0; signs < 8; ++signs) {
    const auto towards = [signs](std::size_t, std::size_t i) { return signs >> i & 1 ? 1.0 : -1.0; };
    add(towards, [&](std::size_t v, std::size_t i) { return -towards(v, i); });
  }
  for (int i = 0; i < 6; ++i) {
    std::array<double, 18> corner;
    for (double& x : corner) x = random.integer(0, 1) == 0 ? -1 : 1;
    add([&](std::size_t v, std::size_t k) { return corner[3 * v + k]; },
        [&](std::size_t v, std::size_t k) { return corner[9 + 3 * v + k]; });
  }
  return attacks;
}

inline Point moved(const Point& p, const Point& by) { return {p.x + by.x, p.y + by.y, p.z + by.z}; }

/// Integers times 64, so that points between them are exact; `reach` in units of 64.
inline Point lattice(Random& random, int reach) {
  const auto coordinate = [&] { return 64.0 * random.integer(-reach, reach); };
  const double x = coordinate(), y = coordinate();
  return {x, y, coordinate()};
}
/// Some with all edges along diagonals, whose determinants errors sway most.
inline Triangle lattice_triangle(Random& random, int reach) {
  const Point p = lattice(random, reach), q = lattice(random, reach);
  if (random.integer(0, 2) != 0) return {p, q, lattice(random, reach)};
  const double length = 64.0 * random.integer(1, reach);
  const auto sign = [&] { return random.integer(0, 1) == 0 ? -length : length; };
  const double third = random.integer(0, 1) * sign();
  Triangle t{p, moved(p, {sign(), sign(), sign()}), moved(p, {sign(), sign(), third})};
  std::rotate(t.begin(), t.begin() + random.integer(0, 2), t.end());
  return t;
}
/// p + i/8 (q - p), exactly.
inline Point between(const Point& p, const Point& q, int i) {
  return {p.x + i * (q.x - p.x) / 8, p.y + i * (q.y - p.y) / 8, p.z + i * (q.z - p.z) / 8};
}

/// Two triangles with just enough in common, or not quite.
inline std::pair<Triangle, Triangle> border_pair(Random& random) {
  const int reach = std::array{16, 16, 1000, 16000}[static_cast<std::size_t>(random.integer(0, 3))];
  const Triangle a = lattice_triangle(random, reach);
  Triangle b = lattice_triangle(random, reach);
  const auto shift_to = [&](const Point& from, const Point& to) {
    const Point by{to.x - from.x, to.y - from.y, to.z - from.z};
    for (Point& p : b) p = moved(p, by);
  };
  const Point on_edge = between(a[0], a[1], random.integer(0, 8));
  switch (random.integer(0, 9)) {
    case 0:  // a vertex on a vertex
      shift_to(b[0], a[0]);
      break;
    case 1:  // a vertex on an edge
      shift_to(b[0], on_edge);
      break;
    case 2:  // a vertex inside
      shift_to(b[0], between(on_edge, a[2], random.integer(0, 8)));
      break;
    case 3:  // an edge through an edge
      shift_to(between(b[0], b[1], random.integer(0, 8)), on_edge);
      break;
    case 4:  // an edge through the inside, near its end
      shift_to(between(b[0], b[1], random.integer(0, 1)), between(on_edge, a[2], random.integer(0, 8)));
      break;
    case 5:  // a common edge
      b[0] = a[0], b[1] = a[1];
      break;
    case 6:  // in one plane
      for (Point& p : b) p = between(between(a[0], a[1], random.integer(-8, 16)), a[2], random.integer(-8, 16));
      break;
    case 7:  // the same
      b = a;
      break;
    case 8:  // without area
      b[2] = between(b[0], b[1], random.integer(-8, 16));
      shift_to(b[0], on_edge);
      break;
    default:  // as they come
      break;
  }
  // A hair off, so that they are apart or cross.
  if (random.integer(0, 2) == 0) {
    Point hair = lattice(random, 1);
    const double length = std::ldexp(1.0, -random.integer(6, 40));
    for (double* x : {&hair.x, &hair.y, &hair.z}) *x *= length;
    for (Point& p : b) p = moved(p, hair);
  }
  return {a, b};
}

inline Triangle scaled(Triangle t, double scale, const Point& offset) {
  for (Point& p : t) p = {scale * p.x + offset.x, scale * p.y + offset.y, scale * p.z + offset.z};
  return t;
}

using AnyPair = std::function<std::pair<Triangle, Triangle>(Random&)>;

/// Likewise, the second triangle `small` times as large and touching the first.
inline AnyPair border_pair_of_sizes(double small) {
  return [small](Random& random) {
    auto [a, b] = border_pair(random);
    const Point at = between(a[0], a[1], random.integer(0, 8)), from = between(b[0], b[1], random.integer(0, 8));
    for (Point& p : b)
      p = {at.x + small * (p.x - from.x), at.y + small * (p.y - from.y), at.z + small * (p.z - from.z)};
    return std::pair{a, b};
  };
}

/// For triangles of about 1000.
constexpr std::array kErrors{0.0,    0x1p-40, 0.0, 0x1p-20, 0x1p-14, 0.0, 0x1p-11,
                             0x1p-6, 0.0,     1.0, 64.0,    4096.0,  0.0, 0x1p30};

/// The pairs are scaled by `scale` and moved by `off`, the errors scaled by `scale` and by `finer`.
template <class T = float>
std::vector<AttackAs<T>> attacks_of(double scale, double off, const AnyPair& any, int rounds, double finer = 1) {
  Seeded seeded(static_cast<std::uint64_t>(std::abs(std::ilogb(scale))) + static_cast<std::uint64_t>(off));
  std::vector<AttackAs<T>> attacks;
  for (int round = 0; round < rounds; ++round) {
    auto [a, b] = any(seeded.random);
    const Point offset{scale * off, -scale * off, scale * off / 2};
    a = scaled(a, scale, offset), b = scaled(b, scale, offset);
    if (seeded.random.integer(0, 1) == 1) std::swap(a, b);
    const double error = scale * finer * kErrors[static_cast<std::size_t>(round) % kErrors.size()];
    const auto more = attacks_on(a, b, static_cast<T>(error), seeded.random);
    attacks.insert(attacks.end(), more.begin(), more.end());
  }
  return attacks;
}

/// How often each verdict was given.
struct Counts {
  std::array<int, 3> of{};
};

/// Fails where a verdict is not true of the exact triangles.
template <class Attacks>
void expect_true(const Attacks& attacks, std::span<const Said> found, Counts& counts) {
  for (std::size_t i = 0; i < attacks.size(); ++i) {
    ++counts.of[static_cast<std::size_t>(found[i])];
    if (found[i] == Said::unsure) continue;
    const auto exact = intersects(attacks[i].a, attacks[i].b);
    ASSERT_EQ(exact, found[i] == Said::no ? std::nullopt : std::optional(Kind::crossing))
        << "error " << attacks[i].pair.error << ", first vertex " << attacks[i].a[0].x << ' ' << attacks[i].a[0].y;
  }
}

}  // namespace impinge::test::filter
