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
  for (const Point& p : shape) text += written(p);
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
  static constexpr int kRounds = 2500;

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
    if (i % 4 == 0) t[2] = t[static_cast<std::size_t>(i / 4 % 2)];
    ASSERT_EQ(is_degenerate(t), exact_corners(t).size() < 3) << written(t);
  }
}

TEST_P(Predicates, EdgeAndTriangle) {
  for (int i = 0; i < kRounds; ++i) {
    const Segment e = segment();
    Triangle t = triangle();
    if (i % 4 == 0) t[0] = e[0];
    const bool expected = oracle::meeting(exact_corners(e), exact_corners(t)).has_value();
    ASSERT_EQ(intersects(e, t), expected) << written(e) << written(t);
    ASSERT_EQ(intersects(Segment{e[1], e[0]}, Triangle{t[2], t[1], t[0]}), expected) << written(e) << written(t);
  }
}

TEST_P(Predicates, TwoTriangles) {
  for (int i = 0; i < kRounds; ++i) {
    const Triangle a = triangle();
    Triangle b = triangle();
    for (int shared = i % 4; shared < 2; ++shared)  // none, one or two common corners
      b[static_cast<std::size_t>(shared)] = a[static_cast<std::size_t>(random_.integer(0, 2))];
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
    for (int shared = i % 4; shared < 2; ++shared)
      b[static_cast<std::size_t>(shared)] = a[static_cast<std::size_t>(random_.integer(0, 2))];
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

/// Edge against polygon, convex or not, held to rational numbers: the edge is cut by the polygon's plane; what is left
/// lies in the polygon if it meets its boundary or starts inside by the parity of a ray.

using oracle::operator-;

constexpr std::uint64_t kSeed = 42;

using Flat = std::vector<std::array<int, 2>>;  // corners in the polygon's own plane

struct Frame {
  std::array<int, 3> origin, u, v;
  [[nodiscard]] Point at(const std::array<int, 2>& p) const {
    const auto coordinate = [&](std::size_t k) { return static_cast<double>(origin[k] + p[0] * u[k] + p[1] * v[k]); };
    return {coordinate(0), coordinate(1), coordinate(2)};
  }
};

int cross2(const std::array<int, 2>& a, const std::array<int, 2>& b) { return a[0] * b[1] - a[1] * b[0]; }

Frame random_frame(Random& random) {
  while (true) {
    Frame frame{};
    for (auto* const axis : {&frame.origin, &frame.u, &frame.v})
      for (int& x : *axis) x = random.integer(-2, 2);
    const auto& u = frame.u;
    const auto& v = frame.v;
    if (u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0]) return frame;
  }
}

/// A polygon that is seen whole from (0, 0): corners by angle, less than half a turn from one to the next.
Flat random_star(Random& random) {
  while (true) {
    Flat corners;
    for (int i = random.integer(3, 9); i > 0; --i) corners.push_back({random.integer(-4, 4), random.integer(-4, 4)});
    const auto half = [](const auto& p) { return p[1] > 0 || (p[1] == 0 && p[0] > 0) ? 0 : 1; };
    std::sort(corners.begin(), corners.end(),
              [&](const auto& a, const auto& b) { return half(a) != half(b) ? half(a) < half(b) : cross2(a, b) > 0; });
    bool star = true;
    for (std::size_t i = 0; i < corners.size(); ++i)
      star = star && cross2(corners[i], corners[(i + 1) % corners.size()]) > 0;
    if (star) return corners;
  }
}

Flat random_polygon(Random& random) {
  static const std::vector<Flat> kFixed{
      {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}},                  // L
      {{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 1}, {1, 1}, {1, 4}, {0, 4}},  // U
      {{0, 0}, {1, 3}, {2, 0}, {3, 3}, {4, 0}, {4, 4}, {0, 4}},          // comb
      {{-3, -3},
       {3, -3},
       {3, 3},
       {-2, 3},
       {-2, -1},
       {1, -1},
       {1, 1},
       {0, 1},
       {0, 0},
       {-1, 0},
       {-1, 2},
       {2, 2},
       {2, -2},
       {-3, -2}},
      {{0, 0}, {2, 0}, {4, 0}, {4, 2}, {4, 4}, {2, 4}, {0, 4}, {0, 2}},  // corners on straight sides
      {{-4, 0}, {0, -1}, {4, 0}, {0, 1}}};
  Flat polygon =
      random.integer(0, 2) == 0 ? kFixed[static_cast<std::size_t>(random.integer(0, 5))] : random_star(random);
  if (random.integer(0, 1) == 0) std::reverse(polygon.begin(), polygon.end());
  std::rotate(polygon.begin(), polygon.begin() + random.integer(0, static_cast<int>(polygon.size()) - 1),
              polygon.end());
  return polygon;
}

/// Whether `x`, in the polygon's plane and not on its boundary, is inside.
bool inside(const oracle::Vec& x, const oracle::Corners& polygon, const oracle::Vec& normal) {
  const std::size_t drop = normal[0] != 0 ? 0 : normal[1] != 0 ? 1 : 2;
  const std::size_t i = (drop + 1) % 3, j = (drop + 2) % 3;
  bool odd = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const oracle::Vec& a = polygon[k];
    const oracle::Vec& b = polygon[(k + 1) % polygon.size()];
    if ((a[j] > x[j]) != (b[j] > x[j]) && x[i] < a[i] + (x[j] - a[j]) / (b[j] - a[j]) * (b[i] - a[i])) odd = !odd;
  }
  return odd;
}

bool meets(const Segment& edge, const std::vector<Point>& corners) {
  oracle::Corners polygon;
  for (const Point& p : corners) polygon.push_back(exact(p));
  oracle::Vec normal = oracle::vec(0, 0, 0);
  for (std::size_t i = 1; i + 1 < polygon.size() && oracle::is_zero(normal); ++i)
    normal = cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  oracle::Corners rest = points::exact_corners(edge);
  rest = oracle::cut(rest, oracle::half_space(normal, polygon[0]));
  rest = oracle::cut(rest, oracle::half_space(oracle::negated(normal), polygon[0]));
  if (rest.empty()) return false;
  rest = oracle::simplified(rest);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto side = oracle::simplified({polygon[i], polygon[(i + 1) % polygon.size()]});
    if (oracle::meeting(rest, side)) return true;
  }
  return inside(rest[0], polygon, normal);
}

TEST(EdgeAndPolygon, IsExact) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random(kSeed);
  int hits = 0, misses = 0;
  for (int round = 0; round < 6000; ++round) {
    const Frame frame = random_frame(random);
    const Flat flat = random_polygon(random);
    std::vector<Point> corners;
    for (const auto& p : flat) corners.push_back(frame.at(p));
    Segment edge{};
    const Point above{static_cast<double>(random.integer(-3, 3)), static_cast<double>(random.integer(-3, 3)),
                      static_cast<double>(random.integer(-3, 3))};
    const Point a = frame.at({random.integer(-5, 5), random.integer(-5, 5)});
    const Point b = frame.at({random.integer(-5, 5), random.integer(-5, 5)});
    switch (random.integer(0, 3)) {
      case 0:  // in the plane
        edge = {a, b};
        break;
      case 1:  // ends in the plane
        edge = {a, {a.x + above.x, a.y + above.y, a.z + above.z}};
        break;
      case 2:  // through the plane
        edge = {Point{a.x - above.x, a.y - above.y, a.z - above.z}, {a.x + above.x, a.y + above.y, a.z + above.z}};
        break;
      default:
        edge = {above, b};
    }
    const double scale = round % 3 == 0 ? 1 : round % 3 == 1 ? 0x1p-358 : 0x1p290;
    const auto scaled = [scale](const Point& p) { return Point{p.x * scale, p.y * scale, p.z * scale}; };
    std::transform(corners.begin(), corners.end(), corners.begin(), scaled);
    edge = {scaled(edge[0]), scaled(edge[1])};
    const bool expected = meets(edge, corners);
    ++(expected ? hits : misses);
    const auto found = intersects(edge, std::span<const Point>(corners));
    ASSERT_TRUE(found.has_value()) << "round " << round << ": " << found.error().message;
    ASSERT_EQ(*found, expected) << "round " << round;
    const auto backwards = intersects(Segment{edge[1], edge[0]}, std::span<const Point>(corners));
    ASSERT_TRUE(backwards.has_value());
    ASSERT_EQ(*backwards, expected) << "round " << round << ", edge turned";
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(misses, 1000);
}

TEST(EdgeAndPolygon, AgreesWithEdgeAndTriangle) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random(kSeed);
  for (const auto& source : {points::integers(-1, 1), points::nearly_degenerate(), points::whole_domain()})
    for (int round = 0; round < 2000; ++round) {
      const std::vector<Point> corners{source(random), source(random), source(random)};
      const Segment edge{source(random), source(random)};
      const Triangle triangle{corners[0], corners[1], corners[2]};
      const auto found = intersects(edge, std::span<const Point>(corners));
      if (points::exact_corners(triangle).size() < 3) {
        ASSERT_FALSE(found.has_value());
        EXPECT_EQ(found.error().code, Code::bad_mesh);
      } else {
        ASSERT_TRUE(found.has_value()) << found.error().message;
        ASSERT_EQ(*found, oracle::meeting(points::exact_corners(edge), points::exact_corners(triangle)).has_value());
      }
    }
}

TEST(EdgeAndPolygon, RefusesWhatIsNoPolygon) {
  const Segment edge{Point{0, 0, 0}, Point{1, 0, 0}};
  const std::vector<std::vector<Point>> bad{
      {},
      {{0, 0, 0}},
      {{0, 0, 0}, {1, 0, 0}},
      {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}},
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0x1p-350}},
      {{0.1, 0.1, 0.1}, {1.3, 0.7, 0.2}, {0.3, 2.9, 0.6}, {-0.9, 2.3, std::nextafter(0.5, 1.0)}}};
  for (const auto& polygon : bad) {
    const auto answer = intersects(edge, std::span<const Point>(polygon));
    ASSERT_FALSE(answer.has_value()) << polygon.size() << " corners";
    EXPECT_EQ(answer.error().code, Code::bad_mesh);
    EXPECT_FALSE(answer.error().message.empty());
  }
}

}  // namespace
}  // namespace impinge
