// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "measure/triangle_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/support.hpp"
#include "tests/measure/exact_distance.hpp"

namespace impinge {
namespace {

using measure::TriangleDistance;

Vec3 random_point(scenes::Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// The largest coordinate of any corner as seen from another's.
double extent(const Triangle& a, const Triangle& b) {
  double most = 0;
  for (const Triangle* const t : {&a, &b})
    for (const Vec3& corner : *t) most = std::max(most, max_component(abs(corner - a[0])));
  return most;
}

/// What is promised; and how much of an error there is in it, as a part of the extent.
double expect_holds(const Triangle& a, const Triangle& b, const TriangleDistance& d) {
  const mpq_class square = oracle::square_distance(a, b);
  EXPECT_GE(square, mpq_class(d.lower) * mpq_class(d.lower)) << "lower bound";
  if (square > 0) {
    EXPECT_TRUE(oracle::is_within(square, d.distance, d.margin))
        << d.distance << " +- " << d.margin << ", not " << std::sqrt(square.get_d());
  }
  EXPECT_LE(d.margin, 0x1p-45 * extent(a, b));
  const double size = extent(a, b);
  return square == 0 || size == 0 ? 0 : std::max(0.0, d.distance - d.lower) / size;
}

/// Families in which one feature or another decides, near and far, thin and degenerate.
Triangle random_triangle(scenes::Random& random, int family) {
  const Vec3 p = random_point(random, 1);
  const auto near = [&](double size) { return p + random_point(random, size); };
  switch (family % 6) {
    case 0:
      return {p, near(1), near(1)};
    case 1:  // small
      return {p, near(1e-3), near(1e-3)};
    case 2: {  // a needle
      const Vec3 q = near(1);
      return {p, q, 0.3 * p + 0.7 * q + random_point(random, std::pow(10.0, random.uniform(-16, -2)))};
    }
    case 3: {  // flat over the plane z = 0, at a height that is often nothing beside the rest
      const double z = std::pow(10.0, random.uniform(-15, 0));
      return {Vec3{p.x, p.y, z}, Vec3{random.uniform(-1, 1), random.uniform(-1, 1), z},
              Vec3{random.uniform(-1, 1), random.uniform(-1, 1), z}};
    }
    case 4: {  // a segment or a point
      const Vec3 q = random.integer(0, 1) == 0 ? near(1) : p;
      return random.integer(0, 1) == 0 ? Triangle{p, q, q} : Triangle{q, p, q};
    }
    default:  // corners on a grid
      return {Vec3{random.integer(0, 3) * 1.0, random.integer(0, 3) * 1.0, random.integer(0, 3) * 1.0},
              Vec3{random.integer(0, 3) * 1.0, random.integer(0, 3) * 1.0, random.integer(0, 3) * 1.0},
              Vec3{random.integer(0, 3) * 1.0, random.integer(0, 3) * 1.0, random.integer(0, 3) * 1.0}};
  }
}

Triangle moved(const Triangle& t, const Vec3& by, double scale) {
  Triangle result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = scale * (t[i] + by);
  return result;
}

TEST(TriangleDistance, HoldsTheExactOne) {
  test::Seeded seeded(20250311);
  double worst = 0;
  for (int i = 0; i < 6000; ++i) {
    const Triangle a = random_triangle(seeded.random, i), b = random_triangle(seeded.random, i / 6);
    const Vec3 away = random_point(seeded.random, i % 7 == 0 ? 1e6 : i % 5 == 0 ? 30 : 0);
    const double scale = i % 11 == 0 ? 0x1p-340 : i % 13 == 0 ? 0x1p270 : 1;
    const Triangle p = moved(a, i % 3 == 0 ? away : Vec3{0, 0, 0}, scale), q = moved(b, away, scale);
    worst = std::max(worst, expect_holds(p, q, measure::triangle_distance(p, q, kInfinity)));
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
  // Where nothing is in the way, the gap between the bounds is a matter of roundings.
  EXPECT_LT(worst, 0x1p-40);
}

/// A thin triangle, and another with a corner over its face: the nearest points of two edges are nearly as near, and
/// the third corners are out of the slab between these but for roundings.
TEST(TriangleDistance, HoldsTheExactOneOfACornerOverANeedle) {
  test::Seeded seeded(11);
  scenes::Random& random = seeded.random;
  const auto up_to_1 = [&](int bits) { return std::exp2(-random.uniform(0, bits)); };
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random_point(random, 1), along = random_point(random, 1);
    const Triangle needle{p, p + along, p + random.unit() * along + random_point(random, up_to_1(50))};
    const Vec3 normal = cross(needle[1] - needle[0], needle[2] - needle[0]), up = (1 / norm(normal)) * normal;
    if (!(norm(normal) > 0)) continue;
    const double s = random.unit(), t = random.uniform(0, 1 - s), size = up_to_1(20);
    const Vec3 corner = needle[0] + s * (needle[1] - needle[0]) + t * (needle[2] - needle[0]) + up_to_1(44) * up;
    const Vec3 end = corner + random_point(random, size);
    Triangle over{corner, end, end + random_point(random, up_to_1(50) * size)};
    for (std::size_t k = 1; k < 3; ++k) {
      const double height = dot(up, over[k] - corner);
      over[k] = over[k] - (height < 0 ? 2 * height : random.unit() < 0.3 ? height : 0) * up;
    }
    if (i % 2 == 0) std::swap(over[0], over[1]);
    const Triangle &a = i % 4 < 2 ? needle : over, &b = i % 4 < 2 ? over : needle;
    expect_holds(a, b, measure::triangle_distance(a, b, kInfinity));
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
}

TEST(TriangleDistance, IsFoundAtPointsOfTheTriangles) {
  test::Seeded seeded(7);
  for (int i = 0; i < 2000; ++i) {
    const Triangle a = random_triangle(seeded.random, i), b = random_triangle(seeded.random, i / 6);
    const TriangleDistance d = measure::triangle_distance(a, b, kInfinity);
    const double slack = 16 * d.margin + 1e-15;
    EXPECT_TRUE(oracle::is_within(oracle::square_distance({d.a, d.a, d.a}, a), 0, slack));
    EXPECT_TRUE(oracle::is_within(oracle::square_distance({d.b, d.b, d.b}, b), 0, slack));
    EXPECT_NEAR(norm(d.b - d.a), d.distance, slack);
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
}

TEST(TriangleDistance, MayEndEarlyOnlyWhereItIsFar) {
  test::Seeded seeded(8);
  for (int i = 0; i < 1500; ++i) {
    const Triangle a = random_triangle(seeded.random, i), b = random_triangle(seeded.random, i / 6);
    const double limit = seeded.random.uniform(0, 1);
    const TriangleDistance d = measure::triangle_distance(a, b, limit, random_point(seeded.random, 1));
    const mpq_class square = oracle::square_distance(a, b);
    EXPECT_GE(square, mpq_class(d.lower) * mpq_class(d.lower));
    EXPECT_TRUE(std::isfinite(d.distance) || d.lower >= limit - 4 * d.margin);
    if (square > 0 && std::isfinite(d.distance)) expect_holds(a, b, d);
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
}

TEST(PointDistance, HoldsTheExactOne) {
  test::Seeded seeded(9);
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const Triangle t = random_triangle(seeded.random, i);
    Vec3 p = random_point(seeded.random, 1);
    if (i % 4 == 0) p = 0.25 * t[0] + 0.25 * t[1] + 0.5 * t[2];
    if (i % 8 == 0) p.z += 1e-12;
    const double scale = i % 11 == 0 ? 0x1p-300 : 1;
    const Triangle u = moved(t, {0, 0, 0}, scale);
    p = scale * p;
    const TriangleDistance d = measure::point_distance(p, u, kInfinity);
    worst = std::max(worst, expect_holds({p, p, p}, u, d));
    EXPECT_EQ(d.a, p);
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
  EXPECT_LT(worst, 0x1p-40);
}

TEST(CommonPoint, IsOnBoth) {
  test::Seeded seeded(10);
  int meeting = 0;
  for (int i = 0; i < 3000; ++i) {
    const Triangle a = random_triangle(seeded.random, i % 2 * 5), b = random_triangle(seeded.random, i / 2 % 2 * 5);
    if (oracle::square_distance(a, b) != 0) continue;
    ++meeting;
    const auto [p, q] = measure::common_point(a, b);
    EXPECT_LT(norm(p - q), 1e-14);
    EXPECT_TRUE(oracle::is_within(oracle::square_distance({p, p, p}, a), 0, 1e-14));
    EXPECT_TRUE(oracle::is_within(oracle::square_distance({q, q, q}, b), 0, 1e-14));
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
  EXPECT_GT(meeting, 100);
}

}  // namespace
}  // namespace impinge
