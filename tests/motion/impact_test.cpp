// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "impinge/predicates.hpp"
#include "tests/core/support.hpp"
#include "tests/motion/rational_impact.hpp"

namespace impinge {
namespace {

using oracle::Features;
using oracle::Points;
using scenes::Random;

struct Case {
  Points from, to;
};

std::optional<Interval> ask(Features features, const Case& c) {
  const auto &p = c.from, &q = c.to;
  return features == Features::vertex_face ? vertex_face_impact(p[0], {p[1], p[2], p[3]}, q[0], {q[1], q[2], q[3]})
                                           : edge_edge_impact({p[0], p[1]}, {p[2], p[3]}, {q[0], q[1]}, {q[2], q[3]});
}

std::string text(const Case& c) {
  std::string result;
  for (const Points* points : {&c.from, &c.to})
    for (const Point& p : *points) result += fmt::format("{{{:a}, {:a}, {:a}}} ", p.x, p.y, p.z);
  return result;
}

/// A scale of its own for each axis: the truth does not depend on it.
Case scaled(Case c, const std::array<int, 3>& exponents) {
  for (Points* points : {&c.from, &c.to})
    for (Point& p : *points)
      p = {std::ldexp(p.x, exponents[0]), std::ldexp(p.y, exponents[1]), std::ldexp(p.z, exponents[2])};
  return c;
}

/// Whether and when, as the oracle has it. Returns whether they meet.
bool check(Features features, const Case& c, const std::array<int, 3>& scales = {}) {
  const auto expected = oracle::first_impact(features, c.from, c.to);
  const auto found = ask(features, scaled(c, scales));
  EXPECT_EQ(expected.has_value(), found.has_value()) << text(c);
  if (!expected || !found) return expected.has_value();
  EXPECT_TRUE(found->lo == found->hi || std::nextafter(found->lo, 2) == found->hi) << text(c);
  // The root is in (lo, hi], or is both.
  if (expected->lo == expected->hi) {
    EXPECT_TRUE(mpq_class(found->lo) <= expected->lo && expected->lo <= mpq_class(found->hi)) << text(c);
  } else {
    EXPECT_TRUE(mpq_class(found->lo) <= expected->hi && expected->lo <= mpq_class(found->hi)) << text(c);
  }
  EXPECT_EQ(found->hi == 0, expected->hi == 0) << text(c);
  return true;
}

/// Few values, so that every degeneracy comes up: roots at the ends, double and triple ones, planes that stay, edges
/// that are points.
Point on_lattice(Random& random, int size) {
  const auto x = [&] { return static_cast<double>(random.integer(-size, size)); };
  return {x(), x(), x()};
}
Point anywhere(Random& random) { return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; }
Point plus(const Point& p, const Point& d, double factor) {
  return {p.x + factor * d.x, p.y + factor * d.y, p.z + factor * d.z};
}

/// Everything passes through one point at a time that is a multiple of 1/8, but for one that often misses it by 2^-48.
Case through_a_point(Random& random) {
  const double t = random.integer(0, 8) / 8.0;
  const Point meeting = on_lattice(random, 3);
  Case c;
  const int corner = random.integer(1, 4);
  for (int i = 0; i < 4; ++i) {
    // At t: the meeting point for one or more, places around it for the others.
    const Point at =
        i == 0 || i == corner || random.integer(0, 3) == 0 ? meeting : plus(meeting, on_lattice(random, 2), 1);
    const Point velocity = on_lattice(random, 3);
    c.from[i] = plus(at, velocity, -t);
    c.to[i] = plus(at, velocity, 1 - t);
  }
  if (random.integer(0, 2) == 0) {
    double& x = c.to[static_cast<std::size_t>(random.integer(0, 3))].x;
    x += random.integer(0, 1) == 0 ? -0x1p-48 : 0x1p-48;
  }
  return c;
}

struct Family {
  std::string name;
  std::function<Case(Random&)> make;
  int fewest;  ///< that meet, of 200
};

const std::vector<Family>& families() {
  static const std::vector<Family> all{
      {"lattice",
       [](Random& random) {
         Case c;
         for (Points* points : {&c.from, &c.to})
           for (Point& p : *points) p = on_lattice(random, 2);
         return c;
       },
       12},
      {"plane",
       [](Random& random) {
         Case c;
         for (Points* points : {&c.from, &c.to})
           for (Point& p : *points) p = on_lattice(random, 3), p.z = 1;
         return c;
       },
       50},
      {"line",
       [](Random& random) {
         Case c;
         for (Points* points : {&c.from, &c.to})
           for (Point& p : *points) p = {static_cast<double>(random.integer(-4, 4)), 0, 1};
         return c;
       },
       50},
      {"still but one",
       [](Random& random) {
         Case c;
         for (Point& p : c.from) p = on_lattice(random, 1);
         c.to = c.from;
         c.to[static_cast<std::size_t>(random.integer(0, 3))] = on_lattice(random, 2);
         return c;
       },
       12},
      {"no motion",
       [](Random& random) {
         Case c;
         for (Point& p : c.from) p = on_lattice(random, 1);
         c.to = c.from;
         return c;
       },
       6},
      {"anywhere",
       [](Random& random) {
         Case c;
         for (Points* points : {&c.from, &c.to})
           for (Point& p : *points) p = anywhere(random);
         return c;
       },
       6},
      {"through a point", through_a_point, 50},
      {"roots within a rounding",
       [](Random& random) {
         // Three differences that are 0 a few bits from t = 1/3, each on an axis of its own: the volume is their
         // product. The places across them pass 0 there too, or stay.
         const auto near = [&] { return 1 + 0x1p-52 * random.integer(0, 2); };
         const auto place = [&] { return random.integer(0, 1) * near(); };
         const auto passing = [&](double at0) { return at0 == 0 ? 0.0 : -2.0; };
         const Point meeting{place(), place(), near()};
         const double a = near(), b = near();
         Case c;
         c.from = {meeting, Point{0, 0, 0}, Point{a, 0, 0}, Point{0, b, 0}};
         c.to = {Point{passing(meeting.x), passing(meeting.y), -2}, Point{0, 0, 0}, Point{-2, 0, 0}, Point{0, -2, 0}};
         if (random.integer(0, 1) == 0) return c;
         for (Points* p : {&c.from, &c.to}) *p = {(*p)[1], (*p)[2], (*p)[0], plus((*p)[0], (*p)[3], 1)};
         return c;
       },
       10},
      {"parallel edges",
       [](Random& random) {
         Case c;
         for (Points* points : {&c.from, &c.to}) {
           const Point way = on_lattice(random, 2);
           (*points)[0] = on_lattice(random, 2);
           (*points)[1] = plus((*points)[0], way, 1);
           (*points)[2] = on_lattice(random, 2);
           (*points)[3] = plus((*points)[2], way, random.integer(0, 1) == 0 ? 1 : 0x1.0000001p0);
         }
         return c;
       },
       6},
  };
  return all;
}

TEST(Impact, OfFourPointsIsThatOfTheRationalDecision) {
  constexpr std::array kScales{-1000, -300, -40, -20, 0, 0, 0, 20, 200, 290, 1000};
  for (const Family& family : families()) {
    SCOPED_TRACE(family.name);
    test::Seeded seeded(20261);
    for (const Features features : {Features::vertex_face, Features::edge_edge}) {
      int hits = 0;
      for (int i = 0; i < 200; ++i) {
        const auto scale = [&] { return kScales[static_cast<std::size_t>(seeded.random.integer(0, 10))]; };
        hits += int{check(features, family.make(seeded.random), {scale(), scale(), scale()})};
        if (testing::Test::HasFailure()) return;
      }
      EXPECT_GE(hits, family.fewest);
    }
  }
}

TEST(Impact, KeepsItsTimeWhereRolesAreExchangedAndMirrorsItWhereTimeRunsBack) {
  test::Seeded seeded(20262);
  for (const Family& family : families())
    for (int i = 0; i < 200; ++i) {
      const Case c = family.make(seeded.random);
      const auto swapped = [](const Points& p) { return Points{p[3], p[2], p[0], p[1]}; };
      const auto turned = [](const Points& p) { return Points{p[0], p[2], p[3], p[1]}; };
      for (const Features features : {Features::vertex_face, Features::edge_edge}) {
        const auto found = ask(features, c);
        const bool faces = features == Features::vertex_face;
        const auto other =
            ask(features, {faces ? turned(c.from) : swapped(c.from), faces ? turned(c.to) : swapped(c.to)});
        ASSERT_EQ(found.has_value(), other.has_value()) << text(c);
        if (found) {
          EXPECT_EQ(found->lo, other->lo) << text(c);
          EXPECT_EQ(found->hi, other->hi) << text(c);
        }
        EXPECT_EQ(found.has_value(), ask(features, {c.to, c.from}).has_value()) << text(c);
      }
    }
}

TEST(Impact, IsCertainWhereCoordinatesSpanTheWholeDomain) {
  // A vertex at 2^299 falls onto a face a step of 2^-358 thick, and one that stops a step above it.
  const double far = std::ldexp(1, 299), step = std::ldexp(1, -358);
  const Points from{Point{0, 0, far}, {-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}};
  Points to = from;
  to[0].z = 0;
  EXPECT_TRUE(check(Features::vertex_face, {from, to}));
  to[0].z = step;
  EXPECT_FALSE(check(Features::vertex_face, {from, to}));
  to[0].z = -step;
  EXPECT_TRUE(check(Features::vertex_face, {from, to}));
}

}  // namespace
}  // namespace impinge
