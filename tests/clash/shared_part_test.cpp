// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/shared_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "tests/core/support.hpp"
#include "tests/exact/pairs.hpp"

/// What two triangles share, against the oracle's cuts by half-spaces in rationals.
namespace impinge {
namespace {

using clash::SharedPart;
using oracle::Corners;
using oracle::Vec;
using oracle::operator-;

/// The double nearest to a number, ties to even: the best of that which GMP's truncation gives and its neighbour.
double nearest(const mpq_class& x) {
  const double low = x.get_d(), high = std::nextafter(low, sgn(x) < 0 ? -INFINITY : INFINITY);
  const mpq_class to_low = abs(x - mpq_class(low)), to_high = abs(mpq_class(high) - x);
  if (to_low != to_high) return to_low < to_high ? low : high;
  int exponent = 0;
  return std::fmod(std::ldexp(std::frexp(low, &exponent), 53), 2) == 0 ? low : high;
}

bool is_between(const Vec& x, const Vec& p, const Vec& q) {
  return oracle::is_zero(oracle::cross(q - p, x - p)) && oracle::dot(x - p, x - q) < 0;
}

/// The common part's corners alone: no point twice, none between two others.
Corners corners_of(Corners points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Corners corners;
  for (const Vec& x : points) {
    const bool inner = std::any_of(points.begin(), points.end(), [&](const Vec& p) {
      return std::any_of(points.begin(), points.end(), [&](const Vec& q) { return is_between(x, p, q); });
    });
    if (!inner) corners.push_back(x);
  }
  return corners;
}

/// Whether all points are on one side of the line through two of them, in their common plane.
bool is_on_border(const Vec& p, const Vec& q, const Corners& points) {
  Vec first = oracle::vec(0, 0, 0);
  for (const Vec& x : points) {
    const Vec side = oracle::cross(q - p, x - p);
    if (oracle::is_zero(first)) first = side;
    if (oracle::dot(first, side) < 0) return false;
  }
  return true;
}

std::uint8_t edges_holding(const test::Pair& pair, const Vec& x) {
  unsigned edges = 0;
  for (unsigned s = 0; s < 2; ++s) {
    if (points::exact_corners(pair[s]).size() != 3) continue;
    for (unsigned i = 0; i < 3; ++i) {
      const Vec p = points::exact(pair[s][i]), q = points::exact(pair[s][(i + 1) % 3]);
      if (x == p || x == q || is_between(x, p, q)) edges |= 1U << (3 * s + i);
    }
  }
  return static_cast<std::uint8_t>(edges);
}

void expect_right(const test::Pair& pair) {
  SCOPED_TRACE(test::written(pair));
  const Corners expected = corners_of(
      oracle::common_part(points::exact_corners(pair[0]), oracle::half_spaces(points::exact_corners(pair[1]))));
  const SharedPart found = clash::shared_part(pair[0], pair[1]);
  ASSERT_EQ(found.size, expected.size());
  // By the edges and the rounded coordinates, each found corner is one of those expected, and no two are the same one.
  std::vector<bool> taken(expected.size());
  Corners in_order;
  for (std::size_t i = 0; i < found.size; ++i) {
    const auto& [p, edges] = found.corners[i];
    EXPECT_FALSE(std::signbit(p.x) && p.x == 0);
    std::size_t at = expected.size();
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const Vec& x = expected[k];
      const bool same = p == Point{nearest(x[0]), nearest(x[1]), nearest(x[2])} && edges == edges_holding(pair, x);
      if (same && !taken[k]) at = k;
    }
    ASSERT_LT(at, expected.size()) << "corner " << i;
    taken[at] = true;
    in_order.push_back(expected[at]);
  }
  for (std::size_t i = 0; in_order.size() > 2 && i < in_order.size(); ++i)
    EXPECT_TRUE(is_on_border(in_order[i], in_order[(i + 1) % in_order.size()], expected)) << "side " << i;
}

TEST(SharedPart, IsThatOfRationalsForEveryFamilyOfHardPairs) {
  test::Seeded seeded(11);
  for (const test::PairFamily& family : test::pair_families()) {
    SCOPED_TRACE(family.name);
    for (int i = 0; i < 150; ++i) {
      const test::Pair pair = family.make(seeded.random);
      expect_right(pair);
      expect_right(test::varied(pair, seeded.random));
      if (testing::Test::HasFailure()) return;
    }
  }
}

/// Every pair of two soups, as if they were meshes.
void expect_right(const scenes::MeshData& a, const scenes::MeshData& b, const Pose& pose) {
  const std::vector<Triangle> as = test::world_triangles(test::mesh_of(a), pose),
                              bs = test::world_triangles(test::mesh_of(b), pose);
  for (const Triangle& ta : as)
    for (const Triangle& tb : bs)
      if (!testing::Test::HasFailure()) expect_right({ta, tb});
}

TEST(SharedPart, IsThatOfRationalsInHardMeshes) {
  test::Seeded seeded(12);
  scenes::Random& random = seeded.random;
  for (int i = 0; i < 4; ++i) {
    Pose pose = scenes::random_motion(random, i == 3 ? 1e6 : 1);
    if (i < 2) pose = {};
    expect_right(scenes::integer_soup(random, 25, 3), scenes::integer_soup(random, 25, 3), pose);
    expect_right(scenes::degenerate_soup(random, 25, 2), scenes::integer_soup(random, 25, 2), pose);
    expect_right(scenes::degenerate_soup(random, 25, 2), scenes::degenerate_soup(random, 25, 2), pose);
    expect_right(scenes::sliver_soup(random, 25), scenes::sliver_soup(random, 25), pose);
    expect_right(scenes::triangle_soup(random, 25, 1), scenes::triangle_soup(random, 25, 1), pose);
  }
}

/// Coplanar triangles share polygons of up to six corners.
TEST(SharedPart, OfCoplanarTrianglesIsAPolygonInOrder) {
  const Triangle a{Point{0, 0, 5}, {6, 0, 5}, {3, 6, 5}}, b{Point{0, 4, 5}, {3, -2, 5}, {6, 4, 5}};
  EXPECT_EQ(clash::shared_part(a, b).size, 6);
  expect_right({a, b});
  test::Seeded seeded(13);
  std::array<int, 7> sizes{};
  for (int i = 0; i < 1500; ++i) {
    const auto random_point = [&] {
      const double x = seeded.random.integer(-4, 4), y = seeded.random.integer(-4, 4);
      return Point{x, y, 2 * x - 3 * y};
    };
    test::Pair pair;
    for (Triangle& t : pair)
      for (Point& p : t) p = random_point();
    ++sizes[clash::shared_part(pair[0], pair[1]).size];
    expect_right(pair);
    if (testing::Test::HasFailure()) return;
  }
  for (const int size : sizes) EXPECT_GT(size, 0);
}

/// What is found quickly is what the exact way finds, bit for bit, whichever corners meet, flat or not, with slivers.
TEST(CommonVertex, IsAllThatIsShared) {
  test::Seeded seeded(15);
  std::size_t found = 0, only_points = 0;
  for (int i = 0; i < 60000; ++i) {
    const int kind = i % 5;
    const double size = kind == 4 ? 0x1p-300 : 1;
    const auto coordinate = [&] { return size * seeded.random.integer(-4, 4); };
    const auto random_point = [&] {
      const double x = coordinate(), y = coordinate();
      // In space; in a plane; in two planes an ulp apart; on a line.
      const double up = kind == 1 ? 0.0 : kind == 2 ? 0x1p-52 * coordinate() : coordinate();
      return kind == 3 ? Point{x, 3 * x, 0x1p-50 * y} : Point{x, y, 2 * x - 3 * y + up};
    };
    Triangle a{random_point(), random_point(), random_point()}, b{random_point(), random_point(), random_point()};
    b[static_cast<std::size_t>(i / 5 % 3)] = a[static_cast<std::size_t>(i / 15 % 3)];
    const auto vertex = clash::common_vertex(a, b);
    const clash::SharedPart part = clash::shared_part(a, b);
    only_points += part.size == 1;
    if (!vertex) continue;
    ++found;
    ASSERT_EQ(part.size, 1) << i;
    EXPECT_EQ(part.corners[0].point, vertex->point);
    EXPECT_EQ(part.corners[0].edges, vertex->edges) << i;
  }
  EXPECT_GT(found, only_points / 10);
}

/// At the ends of the exact domain, where integers of 60 bits do not do.
TEST(SharedPart, IsRoundedOnceAtTheEndsOfTheDomain) {
  const double big = 0x1p299, small = 0x1p-358;
  expect_right({Triangle{Point{small, 3 * small, 0}, {big, small, small}, {-big, big, -big}},
                Triangle{Point{small, -big, big}, {small, big, -big}, {7 * small, -big, -big}}});
  expect_right({Triangle{Point{small, small, 0}, {4 * small, 0, 0}, {0, 5 * small, 0}},
                Triangle{Point{2 * small, small, -small}, {small, 3 * small, 2 * small}, {0, 0, small}}});
}

}  // namespace
}  // namespace impinge
