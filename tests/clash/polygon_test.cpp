// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/support.hpp"

// Cuts of polygons that are convex up to rounding: however planes lie along borders, a cut adds one corner at most, all
// corners are on their side, and nothing is lost.

namespace {

using impinge::Vec3;
using impinge::clash::cut;
using impinge::clash::HalfSpace;
using impinge::clash::Polygon;
namespace test = impinge::test;

double height(const HalfSpace& half, const Vec3& p) { return dot(half.normal, p) - half.offset; }

double area(const Polygon& polygon) {
  Vec3 twice{0, 0, 0};
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice = twice + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * norm(twice);
}

HalfSpace plane_through(const Vec3& from, const Vec3& to, const Vec3& up) {
  const Vec3 out = cross(to - from, up);
  const Vec3 normal = (1 / norm(out)) * out;
  return {normal, dot(normal, from)};
}

TEST(Cut, AddsOneCornerAtMostThoughPlanesLieAlongBorders) {
  constexpr double kRounding = 0x1p-46;  // of coordinates up to 2, and shares of corners that are 2^-6 apart or more
  test::Seeded seeded(31);
  auto& random = seeded.random;
  const auto point = [&] { return Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
  std::size_t twice = 0;  // that borders were met more than twice, as heights are
  for (int trial = 0; trial < 20'000; ++trial) {
    Polygon polygon(impinge::Triangle{point(), point(), point()});
    const Vec3 up = cross(polygon[1] - polygon[0], polygon[2] - polygon[0]);
    for (int step = 0; step < 8; ++step) {
      // Along a border or between two corners, or a few ulps beside them.
      const std::size_t n = polygon.size(), i = random.bits() % n, k = (i + 1 + random.bits() % (n - 1)) % n;
      const Vec3 from = polygon[i], to = polygon[k];
      if (!(norm(to - from) > 0x1p-6)) continue;
      HalfSpace half = plane_through(from, to, up);
      half.offset += 0x1p-53 * random.integer(-4, 4);
      if (random.integer(0, 1) != 0) half = {-1 * half.normal, -half.offset};
      std::size_t signs = 0;
      for (std::size_t j = 0; j < n; ++j)
        signs += (height(half, polygon[j]) > 0) != (height(half, polygon[(j + 1) % n]) > 0) ? 1U : 0U;
      twice += signs > 2 ? 1U : 0U;
      const auto [within, beyond] = cut(polygon, half);
      ASSERT_LE(within.size(), n + 1) << "trial " << trial;
      ASSERT_LE(beyond.size(), n + 1) << "trial " << trial;
      for (const Vec3& p : within) EXPECT_LE(height(half, p), kRounding) << "trial " << trial;
      for (const Vec3& p : beyond) EXPECT_GE(height(half, p), -kRounding) << "trial " << trial;
      EXPECT_NEAR(area(within) + area(beyond), area(polygon), kRounding) << "trial " << trial;
      polygon = area(within) > area(beyond) ? within : beyond;
      if (polygon.is_full()) break;
    }
  }
  EXPECT_GT(twice, 0U) << "rounding was never in the way";
}

}  // namespace
