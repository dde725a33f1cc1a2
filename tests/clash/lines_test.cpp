// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clash/polygon.hpp"
#include "clash/regions/split.hpp"
#include "scenes/random.hpp"
#include "tests/core/support.hpp"

namespace impinge::clash {
namespace {

Vec3 on_axis(double x) { return {x, 0, 0}; }

TEST(Lines, AreWhatTheirPiecesMakeInAnyOrder) {
  // A square, a line of two pieces given twice, and a loop with a tail.
  const std::vector<Vec3> square{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < 4; ++i) pieces.push_back(piece(square[i], square[(i + 1) % 4], 1));
  for (const int i : {0, 1, 0, 1}) pieces.push_back(piece(on_axis(i), on_axis(i + 1)));
  const std::vector<Vec3> loop{{5, 0, 0}, {6, 1, 0}, {6, -1, 0}};
  for (std::size_t i = 0; i < 3; ++i) pieces.push_back(piece(loop[i], loop[(i + 1) % 3]));
  pieces.push_back(piece(loop[0], on_axis(4), 2));
  pieces.push_back(piece(on_axis(4), on_axis(4)));  // a point is no piece of a line
  test::Seeded seeded(1);
  for (int turn = 0; turn < 20; ++turn) {
    for (std::size_t i = pieces.size(); i > 1; --i)
      std::swap(pieces[i - 1], pieces[static_cast<std::size_t>(seeded.random.integer(0, static_cast<int>(i) - 1))]);
    const std::vector<Polyline> lines = joined(pieces);
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_EQ(lines[0].points, (std::vector<Vec3>{on_axis(0), on_axis(1), on_axis(2)}));
    EXPECT_FALSE(lines[0].closed());
    EXPECT_EQ(lines[1].points, (std::vector<Vec3>{on_axis(4), on_axis(5)}));
    EXPECT_EQ(lines[1].flow, -2);
    EXPECT_EQ(lines[2].points, (std::vector<Vec3>{loop[0], loop[2], loop[1], loop[0]}));
    EXPECT_TRUE(lines[2].closed());
    EXPECT_EQ(lines[3].points, (std::vector<Vec3>{square[0], square[1], square[2], square[3], square[0]}));
    EXPECT_EQ(lines[3].flow, 4);
  }
}

/// Two loops that cross in two points: each line keeps its direction of flow there.
TEST(Lines, GoOnAsTheyFlowWhereTheyCross) {
  const Vec3 low{0, 0, 0}, high{0, 1, 0}, left{-1, 0.5, 0}, right{1, 0.5, 0}, in{-0.5, 0.5, 0}, out{0.5, 0.5, 0};
  std::vector<Piece> pieces;
  const auto loop = [&](const std::vector<Vec3>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      pieces.push_back(piece(points[i], points[(i + 1) % points.size()], 1));
  };
  loop({low, out, high, left});
  loop({low, right, high, in});
  const std::vector<Polyline> lines = joined(pieces);
  std::size_t used = 0;
  for (const Polyline& line : lines) {
    EXPECT_TRUE(line.closed());
    EXPECT_EQ(std::abs(line.flow), static_cast<double>(line.points.size() - 1));
    used += line.points.size() - 1;
  }
  EXPECT_EQ(used, pieces.size());
}

TEST(Lines, UseEveryPieceOfANetOnce) {
  test::Seeded seeded(2);
  for (int turn = 0; turn < 50; ++turn) {
    std::vector<Piece> pieces;
    for (int i = 0; i < 60; ++i)
      pieces.push_back(piece(on_axis(seeded.random.integer(0, 12)), on_axis(seeded.random.integer(0, 12))));
    std::vector<std::array<double, 2>> expected, found;
    for (const Piece& p : pieces)
      if (p.from != p.to) expected.push_back({p.from.x, p.to.x});
    for (const Polyline& line : joined(pieces))
      for (std::size_t i = 1; i < line.points.size(); ++i)
        found.push_back(
            {std::min(line.points[i - 1].x, line.points[i].x), std::max(line.points[i - 1].x, line.points[i].x)});
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

/// Against trying every point: on a grid, with points on and off the pieces.
TEST(Splitter, DividesPiecesAtAllPointsOnThem) {
  test::Seeded seeded(3);
  const auto coordinate = [&] { return static_cast<double>(seeded.random.integer(-4, 4)); };
  for (int turn = 0; turn < 30; ++turn) {
    std::vector<Vec3> points;
    for (int i = 0; i < 150; ++i) points.push_back({coordinate(), coordinate(), turn % 2 == 0 ? 0 : coordinate()});
    std::vector<Piece> pieces;
    for (std::size_t i = 1; i < points.size(); ++i)
      pieces.push_back(piece(points[i - 1], points[i], norm(points[i] - points[i - 1])));
    const Splitter splitter(points, {{0.5, 0.25, 0}, 8, 0x1p-40});
    for (const Piece& whole : pieces) {
      std::vector<Vec3> expected{whole.from, whole.to};
      for (const Vec3& p : points) {
        const Vec3 way = whole.to - whole.from, from = p - whole.from;
        const double along = dot(from, way);
        if (norm(cross(from, way)) == 0 && along > 0 && along < dot(way, way)) expected.push_back(p);
      }
      std::sort(expected.begin(), expected.end(), less);
      expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
      std::vector<Piece> parts = splitter.split({whole});
      if (whole.from == whole.to) continue;
      std::sort(parts.begin(), parts.end(), [](const Piece& x, const Piece& y) { return less(x.from, y.from); });
      ASSERT_EQ(parts.size() + 1, expected.size());
      for (std::size_t i = 0; i < parts.size(); ++i) {
        EXPECT_EQ(parts[i].from, expected[i]);
        EXPECT_EQ(parts[i].to, expected[i + 1]);
        EXPECT_NEAR(parts[i].flow, std::copysign(norm(parts[i].to - parts[i].from), whole.flow), 1e-12);
      }
    }
  }
}

/// Points as near to each other as pieces may be to them: dividing comes to an end, and leaves as many ends at a point,
/// by twos, as there were.
TEST(Splitter, ComesToAnEndAmongPointsThatAreClose) {
  const double height = std::sqrt(0.75);
  const std::vector<Vec3> triangle{{0, 0, 0}, {1, 0, 0}, {0.5, height, 0}};
  const Splitter of_three(triangle, {{0, 0, 0}, 1, 1});
  std::vector<Piece> sides;
  for (std::size_t i = 0; i < 3; ++i) sides.push_back(piece(triangle[i], triangle[(i + 1) % 3]));
  EXPECT_EQ(of_three.split_closely(sides, thinned).size(), 3u);

  test::Seeded seeded(4);
  std::vector<Vec3> points;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) points.push_back({0.1 * i + 0.05 * j, 0.1 * height * j, 0});
  std::vector<Piece> pieces;
  const auto any = [&] { return points[static_cast<std::size_t>(seeded.random.integer(0, 399))]; };
  for (int i = 0; i < 400; ++i) pieces.push_back(piece(any(), any()));
  const auto odd_ends = [&](const std::vector<Piece>& some) {
    std::vector<bool> odd(points.size());
    for (const Piece& p : some)
      for (const Vec3& end : {p.from, p.to}) {
        const auto at = std::find(points.begin(), points.end(), end) - points.begin();
        odd[static_cast<std::size_t>(at)] = !odd[static_cast<std::size_t>(at)];
      }
    return odd;
  };
  const Splitter splitter(points, {{1, 1, 0}, 1, 0.2});
  const std::vector<Piece> parts = splitter.split_closely(pieces, thinned);
  EXPECT_EQ(odd_ends(parts), odd_ends(pieces));
  // Of a lattice's points those next to each other are the only ones between which there is no other.
  EXPECT_LE(parts.size(), 2 * 3 * points.size());
}

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

/// Cuts of polygons that are convex up to rounding: however planes lie along borders, a cut adds one corner at most,
/// all corners are on their side, and nothing is lost.
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
}  // namespace impinge::clash
