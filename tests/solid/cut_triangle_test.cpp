// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/cut_triangle.hpp"

#include <gtest/gtest.h>

#include "exact/triangle_pair.hpp"
#include "impinge/predicates.hpp"
#include "scenes/motion.hpp"
#include "tests/core/support.hpp"
#include "tests/oracle/points.hpp"

namespace impinge {
namespace {

using oracle::Corners;
using oracle::Vec;
using scenes::Random;

Vec theirs(const exact::RationalPoint& p) {
  return {mpq_class(p[0].str()), mpq_class(p[1].str()), mpq_class(p[2].str())};
}

Corners theirs(const std::vector<exact::RationalPoint>& points) {
  Corners corners;
  for (const exact::RationalPoint& p : points) corners.push_back(theirs(p));
  return corners;
}

/// Twice the area of a polygon, times the normal's length: along the normal of the triangle that it is a part of.
mpq_class area(const Corners& polygon, const Vec& normal) {
  Vec sum = oracle::vec(0, 0, 0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec part =
        oracle::cross(oracle::operator-(polygon[i], polygon[0]), oracle::operator-(polygon[i + 1], polygon[0]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return oracle::dot(sum, normal);
}

/// On the inner side of every edge of a convex polygon that turns left about the normal.
bool strictly_inside(const Vec& p, const Corners& polygon, const Vec& normal) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec along = oracle::operator-(polygon[(i + 1) % polygon.size()], polygon[i]);
    if (oracle::dot(oracle::cross(normal, along), oracle::operator-(p, polygon[i])) <= 0) return false;
  }
  return oracle::dot(normal, oracle::operator-(p, polygon[0])) == 0;
}

Vec mean(const Corners& corners) {
  Vec sum = oracle::vec(0, 0, 0);
  for (const Vec& corner : corners)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += corner[k] / static_cast<unsigned long>(corners.size());
  return sum;
}

/// Pieces add up to the triangle without what is shared (which does not overlap), turn left strictly, have their points
/// inside, and meet no cutting triangle there: the common part of two convex sets has its mean inside one of them if
/// and only if the other meets that one's inside.
void expect_pieces(const Triangle& t, const std::vector<Triangle>& shared, const std::vector<Triangle>& cutting) {
  const solid::CutTriangle cut(t, shared, cutting);
  const Corners whole = points::exact_corners(t);
  const Vec normal = oracle::cross(oracle::operator-(whole[1], whole[0]), oracle::operator-(whole[2], whole[0]));
  mpq_class left = area(whole, normal);
  for (const Triangle& other : shared)
    left -= abs(area(oracle::common_part(whole, oracle::half_spaces(points::exact_corners(other))), normal));
  for (std::size_t i = 0; i < cut.pieces(); ++i) {
    Corners piece = theirs(cut.corners(i));
    ASSERT_GE(piece.size(), 3u);
    if (area(piece, normal) < 0) std::reverse(piece.begin(), piece.end());
    left -= area(piece, normal);
    ASSERT_TRUE(strictly_inside(mean(piece), piece, normal));
    ASSERT_TRUE(strictly_inside(theirs(cut.point_in(i)), piece, normal));
    for (const Triangle& other : cutting) {
      const Corners common = oracle::common_part(piece, oracle::half_spaces(points::exact_corners(other)));
      ASSERT_FALSE(!common.empty() && strictly_inside(mean(common), piece, normal));
    }
  }
  ASSERT_EQ(left, 0);
}

Triangle proper(const points::Source& point, Random& random) {
  for (;;) {
    const Triangle t{point(random), point(random), point(random)};
    if (!is_degenerate(t)) return t;
  }
}

std::vector<Triangle> cutting(const Triangle& t, const points::Source& point, int n, Random& random) {
  std::vector<Triangle> others;
  for (int i = 0; i < n; ++i) {
    Triangle other = proper(point, random);
    for (Point& p : other)
      if (random.integer(0, 3) == 0) p = t[static_cast<std::size_t>(random.integer(0, 2))];
    if (random.integer(0, 2) == 0) other[0] = 0.25 * (t[0] + t[1] + 2.0 * t[2]);  // often all that is shared
    const auto kind = is_degenerate(other) ? std::nullopt : exact::classify(t, other);
    if (kind && kind != Kind::coplanar) others.push_back(other);
  }
  return others;
}

TEST(CutTriangle, PiecesMeetNothingAndAreAllThatIsLeft) {
  for (std::uint64_t seed = 1; seed <= 120u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const auto point = seed % 3 == 0 ? points::nearly_degenerate() : points::integers(-2, 2);
    const Triangle t = proper(point, random);
    ASSERT_NO_FATAL_FAILURE(expect_pieces(t, {}, cutting(t, point, random.integer(0, 12), random)));
  }
}

/// More than are held against a piece at once, and in a plane of any slope.
TEST(CutTriangle, TakesOutWhatManyShareWithIt) {
  for (std::uint64_t seed = 1; seed <= 40u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const Point e = points::integers(-3, 3)(random), f = points::integers(-3, 3)(random);
    const auto at = [&](int i, int j) { return static_cast<double>(i) * e + static_cast<double>(j) * f; };
    if (is_degenerate({Point{0, 0, 0}, e, f})) continue;
    std::vector<Triangle> shared;
    const int n = random.integer(1, 8);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const std::array<Triangle, 2> halves{Triangle{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                             Triangle{at(i, j), at(i, j + 1), at(i + 1, j + 1)}};
        for (const Triangle& half : halves)
          if (random.integer(0, 3) != 0) shared.push_back(half);
      }
    const auto in_plane = [&](Random& r) {
      const int i = r.integer(-2, 2 * n + 2);
      return 0.5 * at(i, r.integer(-2, 2 * n + 2));
    };
    const Triangle t = proper(in_plane, random);
    const points::Source around = [&](Random& r) { return in_plane(r) + points::integers(-1, 1)(r); };
    ASSERT_NO_FATAL_FAILURE(expect_pieces(t, shared, cutting(t, around, random.integer(0, 30), random)));
  }
}

/// Cuts an ulp apart leave slivers that hold no point of few digits.
TEST(CutTriangle, FindsPointsInSlivers) {
  for (std::uint64_t seed = 1; seed <= 40u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const Pose pose = scenes::random_motion(random, seed % 2 == 0 ? 1 : 1e6);
    const auto placed = [&](const Triangle& t) {
      return Triangle{world_vertex(pose, t[0]), world_vertex(pose, t[1]), world_vertex(pose, t[2])};
    };
    const Triangle t = placed({Point{-1, -1, 0}, {2, -1, 0}, {0, 3, 0}});
    std::vector<Triangle> others;
    for (int i = 0; i < 4; ++i) {
      Triangle other = placed({Point{-3, 0, -3}, {3, 0.5, -3}, {0, 0.25, 3}});
      for (Point& p : other) p.x = std::nextafter(p.x, random.integer(0, 1) == 0 ? -1e300 : 1e300);
      others.push_back(other);
    }
    ASSERT_NO_FATAL_FAILURE(expect_pieces(t, {}, others));
  }
}

TEST(CutTriangle, WorksAtTheEndsOfTheDomain) {
  for (std::uint64_t seed = 1; seed <= 40u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const auto point = seed % 2 == 0 ? points::whole_domain() : points::stretched_integers(0x1p298, 0x1p-358, 1);
    const Triangle t = proper(point, random);
    ASSERT_NO_FATAL_FAILURE(expect_pieces(t, {}, cutting(t, point, 12, random)));
  }
}

}  // namespace
}  // namespace impinge
