// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/triangulate.hpp"

#include <chrono>
#include <cmath>
#include <numeric>
#include <random>

#include "impinge/predicates.hpp"
#include "support.hpp"

namespace impinge::io {
namespace {

struct Cut {
  std::vector<std::uint32_t> triangles;
  std::uint64_t fanned;
};

Cut cut(const std::vector<double>& xyz, std::uint64_t work_limit = 1'000'000'000) {
  std::vector<std::uint32_t> polygon(xyz.size() / 3);
  std::iota(polygon.begin(), polygon.end(), 0u);
  Triangulator triangulator(xyz, work_limit);
  Cut out{};
  triangulator.append(polygon, out.triangles);
  out.fanned = triangulator.fanned();
  return out;
}

/// Polygons of the plane z = x + 2 y + 3, which no axis is normal to.
std::vector<double> lifted(const std::vector<std::array<double, 2>>& outline) {
  std::vector<double> xyz;
  for (const auto& [x, y] : outline) xyz.insert(xyz.end(), {x, y, x + 2 * y + 3});
  return xyz;
}

/// Twice the signed area of each triangle in the plane; none may be turned against the polygon.
double doubled_area(const std::vector<std::array<double, 2>>& outline, const std::vector<std::uint32_t>& triangles) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const auto &a = outline[triangles[i]], &b = outline[triangles[i + 1]], &c = outline[triangles[i + 2]];
    EXPECT_GE(orient2d(a[0], a[1], b[0], b[1], c[0], c[1]), 0) << "triangle " << i / 3;
    sum += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  return sum;
}

double doubled_area(const std::vector<std::array<double, 2>>& outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

TEST(Triangulate, ConvexAndFlatPolygonsAreFans) {
  using List = std::vector<std::uint32_t>;
  EXPECT_EQ(cut(lifted({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}})).triangles, (List{0, 1, 2, 0, 2, 3, 0, 3, 4}));
  EXPECT_EQ(cut(lifted({{0, 0}, {1, 0}, {2, 0}, {2, 2}})).triangles, (List{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(cut({0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3}).triangles, (List{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(cut({5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5}).triangles, (List{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(cut({0, 0, 0, 1, 1, 1}).triangles, List{});
  EXPECT_EQ(cut({}).triangles, List{});
}

TEST(Triangulate, AConcaveQuadIsCutAtItsReflexCorner) {
  using List = std::vector<std::uint32_t>;  // the point (1, 1) is the reflex corner, an end of the diagonal
  EXPECT_EQ(cut(lifted({{0, 0}, {4, 0}, {1, 1}, {0, 4}})).triangles, (List{0, 1, 2, 2, 3, 0}));
  EXPECT_EQ(cut(lifted({{4, 0}, {1, 1}, {0, 4}, {0, 0}})).triangles, (List{3, 0, 1, 1, 2, 3}));
  EXPECT_EQ(cut(lifted({{0, 4}, {0, 0}, {4, 0}, {1, 1}})).triangles, (List{3, 0, 1, 1, 2, 3}));
  EXPECT_EQ(cut(lifted({{1, 1}, {0, 4}, {0, 0}, {4, 0}})).triangles, (List{0, 1, 2, 2, 3, 0}));
}

TEST(Triangulate, ConcavePolygonsAreCoveredOnceInBothDirections) {
  const std::vector<std::vector<std::array<double, 2>>> outlines{
      {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {4, 3}, {4, 4}, {0, 4}},                          // a C
      {{0, 0}, {9, 0}, {9, 9}, {6, 9}, {6, 1}, {5, 9}, {4, 1}, {3, 9}, {2, 1}, {1, 9}, {0, 9}},  // a comb
      {{0, 0}, {2, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {2, 6}, {0, 6}, {0, 3}},                  // an L, flat corners
      {{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {2, 2}, {2, 6}, {6, 6}, {6, 2}, {2, 2}},          // a bridge to a hole
      {{0, 0}, {3, 0}, {3, 0}, {3, 3}, {2, 1}, {2, 1}, {0, 3}},                                  // repeated corners
  };
  for (const auto& outline : outlines) {
    const double area = doubled_area(outline);
    ASSERT_GT(area, 0);
    SCOPED_TRACE("outline of area " + std::to_string(area / 2));
    const Cut forward = cut(lifted(outline));
    EXPECT_EQ(forward.triangles.size(), 3 * (outline.size() - 2));
    EXPECT_EQ(doubled_area(outline, forward.triangles), area);
    EXPECT_EQ(forward.fanned, 0u);
    std::vector<std::array<double, 2>> reversed(outline.rbegin(), outline.rend());
    Cut backward = cut(lifted(reversed));
    for (std::size_t i = 0; i < backward.triangles.size(); i += 3)
      std::swap(backward.triangles[i], backward.triangles[i + 1]);
    EXPECT_EQ(doubled_area(reversed, backward.triangles), area);
  }
}

TEST(Triangulate, RandomStarShapedPolygonsAreCoveredOnce) {
  const unsigned seed = 20250611;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int round = 0; round < 300; ++round) {
    const int n = std::uniform_int_distribution(4, 200)(random);
    std::vector<std::array<double, 2>> outline;
    for (int i = 0; i < n; ++i) {  // integers below 2^20: areas are exact in double
      const double angle = 2 * 3.14159265358979 * i / n;
      const double radius = std::uniform_int_distribution(1 << 14, 1 << 20)(random);
      outline.push_back({std::round(radius * std::cos(angle)), std::round(radius * std::sin(angle))});
    }
    const Cut result = cut(lifted(outline));
    ASSERT_EQ(result.triangles.size(), 3 * (outline.size() - 2));
    if (result.fanned == 0) {
      ASSERT_EQ(doubled_area(outline, result.triangles), doubled_area(outline)) << "round " << round;
    }
    ASSERT_EQ(result.fanned, 0u) << "round " << round;
  }
}

TEST(Triangulate, OutlinesThatCrossThemselvesKeepTheirCountAndAreReported) {
  const Cut star = cut({0, 3, 0, 2, -3, 0, -3, 1, 0, 3, 1, 0, -2, -3, 0, 0, -1, 0, 5, 5, 0, -5, 4, 0});
  EXPECT_EQ(star.triangles.size(), 3 * 6u);
  const Cut bow = cut({0, 0, 0, 4, 4, 0, 4, 0, 0, 0, 5, 0});
  EXPECT_EQ(bow.triangles.size(), 3 * 2u);
}

TEST(Triangulate, CoordinatesOutsideTheExactDomainBecomeAFan) {
  EXPECT_EQ(cut({0, 0, 0, 1e300, 0, 0, 1e299, 1e299, 0, 0, 1e300, 0}).triangles,
            (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

/// A zigzag band of n corners: half of them are reflex.
std::vector<double> zigzag(std::size_t n) {
  std::vector<double> xyz;
  const auto half = static_cast<double>(n / 2);
  for (std::size_t i = 0; i < n / 2; ++i) xyz.insert(xyz.end(), {static_cast<double>(i), i % 2 ? 1.0 : 0.0, 0});
  for (std::size_t i = 0; i < n / 2; ++i)
    xyz.insert(xyz.end(), {half - 1 - static_cast<double>(i), i % 2 ? 2.5 : 3.5, 0});
  return xyz;
}

TEST(Triangulate, AHundredThousandCornersTakeSeconds) {
  const auto start = std::chrono::steady_clock::now();
  const Cut result = cut(zigzag(100'000));
  EXPECT_EQ(result.triangles.size(), 3u * 99'998);
  EXPECT_EQ(result.fanned, 0u);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST(Triangulate, PastTheWorkLimitTheRestBecomesAFanAndIsReported) {
  const Cut result = cut(zigzag(1000), 100);
  EXPECT_EQ(result.triangles.size(), 3u * 998);
  EXPECT_EQ(result.fanned, 1u);
}

}  // namespace
}  // namespace impinge::io
