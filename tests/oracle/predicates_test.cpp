// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Every public predicate against rational numbers, on random input that is mostly degenerate, nearly so, or at the
/// borders of the domain. The seeds are fixed and named in failures.
#include "impinge/predicates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "points.hpp"

namespace impinge {
namespace {

using oracle::cross;
using oracle::dot;
using oracle::operator-;
using points::exact;
using points::exact_corners;
using scenes::Random;

struct Input {
  const char* name;
  points::Source source;
};

std::ostream& operator<<(std::ostream& out, const Input& input) { return out << input.name; }

std::string written(const Point& p) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "(%a, %a, %a) ", p.x, p.y, p.z);
  return text.data();
}

template <class Shape>
std::string written(const Shape& shape) {
  std::string text;
  for (const Point& p : shape) {
    text += written(p);
  }
  return text;
}

/// In one plane but for rounding, from near its origin and from far, so that differences are rounded too.
points::Source nearly_degenerate_of_all_sizes() {
  return [](Random& random) {
    const double s = std::ldexp(random.integer(-3, 3), random.integer(-30, 30));
    const double t = random.integer(0, 1) == 0 ? 0 : std::ldexp(random.integer(-3, 3), random.integer(-30, 30));
    return Point{0.1 + 0.7 * s + 0.3 * t, 12.3 - 0.2 * s + 0.9 * t, -7.7 + 0.6 * s + 0.1 * t};
  };
}

/// Integers with what is left of zeros and ones when they were computed: more bits than a word holds.
points::Source dusty_integers() {
  return [](Random& random) {
    const auto number = [&] {
      const double dust = random.integer(0, 2) == 0 ? std::ldexp(random.integer(-3, 3), random.integer(-62, -52)) : 0;
      return random.integer(-1, 2) + dust;
    };
    const double x = number();
    const double y = number();
    return Point{x, y, number()};
  };
}

/// Integers, off by nothing or by numbers so small that products of them are none.
points::Source units_and_least() {
  return [](Random& random) {
    const auto number = [&]() -> double {
      const double tiny = std::ldexp(random.integer(-2, 2), -random.integer(355, 1074));
      return random.integer(0, 1) == 0 ? random.integer(-1, 1) : tiny;
    };
    const double x = number();
    const double y = number();
    return Point{x, y, number()};
  };
}

class Predicates : public testing::TestWithParam<Input> {
 protected:
  static constexpr std::uint64_t kSeed = 20240117;
  static constexpr int kRounds = 4000;

  Point point() { return GetParam().source(random_); }
  Segment segment() {
    const Point a = point();
    return {a, point()};
  }
  Triangle triangle() {
    const Point a = point();
    const Point b = point();
    return {a, b, point()};
  }

  Random random_{kSeed};
  testing::ScopedTrace trace_{__FILE__, __LINE__, "seed " + std::to_string(kSeed)};
};

std::optional<Kind> kind_of(const std::optional<oracle::Meeting>& meeting) {
  return meeting ? std::optional(static_cast<Kind>(*meeting)) : std::nullopt;
}

TEST_P(Predicates, Orient2d) {
  std::array<int, 3> seen{};
  for (int i = 0; i < kRounds; ++i) {
    const Triangle t = triangle();
    const auto a = exact(t[0]), b = exact(t[1]), c = exact(t[2]);
    const int expected = sgn(mpq_class((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])));
    ++seen[static_cast<std::size_t>(expected + 1)];
    ASSERT_EQ(orient2d(t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y), expected) << written(t);
  }
  EXPECT_GT(seen[0], 0);
  EXPECT_GT(seen[2], 0);
}

TEST_P(Predicates, Orient3d) {
  std::array<int, 3> seen{};
  for (int i = 0; i < kRounds; ++i) {
    const Triangle t = triangle();
    const Point d = point();
    const auto a = exact(t[0]);
    const int expected = sgn(dot(cross(exact(t[1]) - a, exact(t[2]) - a), exact(d) - a));
    ++seen[static_cast<std::size_t>(expected + 1)];
    ASSERT_EQ(orient3d(t[0], t[1], t[2], d), expected) << written(t) << written(d);
  }
  EXPECT_GT(seen[0], 0);
  EXPECT_GT(seen[2], 0);
}

TEST_P(Predicates, IsDegenerate) {
  for (int i = 0; i < kRounds; ++i) {
    Triangle t = triangle();
    if (i % 4 == 0) {
      t[2] = t[static_cast<std::size_t>(i / 4 % 2)];
    }
    ASSERT_EQ(is_degenerate(t), exact_corners(t).size() < 3) << written(t);
  }
}

TEST_P(Predicates, EdgeAndTriangle) {
  for (int i = 0; i < kRounds; ++i) {
    const Segment e = segment();
    Triangle t = triangle();
    if (i % 4 == 0) {
      t[0] = e[0];
    }
    const bool expected = oracle::meeting(exact_corners(e), exact_corners(t)).has_value();
    ASSERT_EQ(intersects(e, t), expected) << written(e) << written(t);
    ASSERT_EQ(intersects(Segment{e[1], e[0]}, Triangle{t[2], t[1], t[0]}), expected) << written(e) << written(t);
  }
}

TEST_P(Predicates, TwoTriangles) {
  for (int i = 0; i < kRounds; ++i) {
    const Triangle a = triangle();
    Triangle b = triangle();
    for (int shared = i % 4; shared < 2; ++shared) {  // none, one or two common corners
      b[static_cast<std::size_t>(shared)] = a[static_cast<std::size_t>(random_.integer(0, 2))];
    }
    const auto expected = kind_of(oracle::meeting(exact_corners(a), exact_corners(b)));
    const bool area = oracle::common_area(exact_corners(a), exact_corners(b));
    const Triangle turned{b[1], b[2], b[0]};
    const Triangle flipped{b[0], b[2], b[1]};
    ASSERT_EQ(intersects(a, b), expected) << written(a) << written(b);
    ASSERT_EQ(intersects(b, a), expected) << written(a) << written(b);
    ASSERT_EQ(intersects(a, turned), expected) << written(a) << written(b);
    ASSERT_EQ(intersects(flipped, a), expected) << written(a) << written(b);
    ASSERT_EQ(share_area(a, b), area) << written(a) << written(b);
    ASSERT_EQ(share_area(flipped, a), area) << written(a) << written(b);
  }
}

TEST_P(Predicates, TwoPlanes) {
  for (int i = 0; i < kRounds; ++i) {
    const Triangle a = triangle();
    Triangle b = triangle();
    for (int shared = i % 4; shared < 2; ++shared) {
      b[static_cast<std::size_t>(shared)] = a[static_cast<std::size_t>(random_.integer(0, 2))];
    }
    const auto planes = classify_planes(a, b);
    const oracle::Vec normal_a = cross(exact(a[1]) - exact(a[0]), exact(a[2]) - exact(a[0]));
    const oracle::Vec normal_b = cross(exact(b[1]) - exact(b[0]), exact(b[2]) - exact(b[0]));
    if (oracle::is_zero(normal_a) || oracle::is_zero(normal_b)) {
      ASSERT_FALSE(planes) << written(a) << written(b);
      EXPECT_EQ(planes.error().code, Code::bad_mesh);
      continue;
    }
    ASSERT_TRUE(planes) << written(a) << written(b) << planes.error().message;
    const bool parallel = oracle::is_zero(cross(normal_a, normal_b));
    const bool same = parallel && dot(normal_a, exact(b[0]) - exact(a[0])) == 0;
    ASSERT_EQ(*planes, same       ? PlanePair::same
                       : parallel ? PlanePair::parallel
                                  : PlanePair::crossing)
        << written(a) << written(b);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Inputs, Predicates,
    testing::Values(Input{"Integers0To1", points::integers(0, 1)}, Input{"IntegersMinus1To1", points::integers(-1, 1)},
                    Input{"Integers0To3", points::integers(0, 3)},
                    Input{"NearlyDegenerate", points::nearly_degenerate()}, Input{"Uniform", points::anything()},
                    Input{"NearlyDegenerateOfAllSizes", nearly_degenerate_of_all_sizes()},
                    Input{"DustyIntegers", dusty_integers()}, Input{"WholeDomain", points::whole_domain()},
                    Input{"LatticeOfSmallest", points::stretched_integers(0x1p-358, 0x1p-358, 0x1p-358)},
                    Input{"LatticeOfLargest", points::stretched_integers(0x1p299, 0x1p299, 0x1p299)},
                    Input{"LatticeOfBoth", points::stretched_integers(0x1p299, 1, 0x1p-358)},
                    Input{"LatticeOfLeast", points::stretched_integers(5e-324, 5e-324, 5e-324)},
                    Input{"LatticeBesideUnits", points::stretched_integers(1, 0x1p-359, 5e-324)},
                    Input{"LatticeOfAll", points::stretched_integers(0x1p299, 1, 5e-324)},
                    Input{"UnitsAndLeast", units_and_least()}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace impinge
