// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Edge against polygon, convex or not, held to rational numbers: the edge is cut by the polygon's plane; what is left
/// lies in the polygon if it meets its boundary or starts inside by the parity of a ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "impinge/predicates.hpp"
#include "points.hpp"

namespace impinge {
namespace {

using oracle::cross;
using oracle::operator-;
using points::exact;
using scenes::Random;

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
    for (auto* const axis : {&frame.origin, &frame.u, &frame.v}) {
      for (int& x : *axis) {
        x = random.integer(-2, 2);
      }
    }
    const auto& u = frame.u;
    const auto& v = frame.v;
    if (u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0]) {
      return frame;
    }
  }
}

/// A polygon that is seen whole from (0, 0): corners by angle, less than half a turn from one to the next.
Flat random_star(Random& random) {
  while (true) {
    Flat corners;
    for (int i = random.integer(3, 9); i > 0; --i) {
      corners.push_back({random.integer(-4, 4), random.integer(-4, 4)});
    }
    const auto half = [](const auto& p) { return p[1] > 0 || (p[1] == 0 && p[0] > 0) ? 0 : 1; };
    std::sort(corners.begin(), corners.end(),
              [&](const auto& a, const auto& b) { return half(a) != half(b) ? half(a) < half(b) : cross2(a, b) > 0; });
    bool star = true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      star = star && cross2(corners[i], corners[(i + 1) % corners.size()]) > 0;
    }
    if (star) {
      return corners;
    }
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
  if (random.integer(0, 1) == 0) {
    std::reverse(polygon.begin(), polygon.end());
  }
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
    if ((a[j] > x[j]) != (b[j] > x[j]) && x[i] < a[i] + (x[j] - a[j]) / (b[j] - a[j]) * (b[i] - a[i])) {
      odd = !odd;
    }
  }
  return odd;
}

bool meets(const Segment& edge, const std::vector<Point>& corners) {
  oracle::Corners polygon;
  for (const Point& p : corners) {
    polygon.push_back(exact(p));
  }
  oracle::Vec normal = oracle::vec(0, 0, 0);
  for (std::size_t i = 1; i + 1 < polygon.size() && oracle::is_zero(normal); ++i) {
    normal = cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  oracle::Corners rest = points::exact_corners(edge);
  rest = oracle::cut(rest, oracle::half_space(normal, polygon[0]));
  rest = oracle::cut(rest, oracle::half_space(oracle::negated(normal), polygon[0]));
  if (rest.empty()) {
    return false;
  }
  rest = oracle::simplified(rest);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto side = oracle::simplified({polygon[i], polygon[(i + 1) % polygon.size()]});
    if (oracle::meeting(rest, side)) {
      return true;
    }
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
    for (const auto& p : flat) {
      corners.push_back(frame.at(p));
    }
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
  for (const auto& source : {points::integers(-1, 1), points::nearly_degenerate(), points::whole_domain()}) {
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
