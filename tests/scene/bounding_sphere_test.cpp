// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene/bounding_sphere.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/number.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

Sphere sphere_of(std::span<const Vec3> points) { return scene::bounding_sphere(points, scene::vertex_numbers(points)); }

void expect_holds_all(const Sphere& sphere, std::span<const Vec3> points) {
  const mpq_class radius(sphere.radius);
  for (const Vec3& p : points) {
    const mpq_class x = mpq_class(p.x) - sphere.center.x, y = mpq_class(p.y) - sphere.center.y,
                    z = mpq_class(p.z) - sphere.center.z;
    ASSERT_LE(x * x + y * y + z * z, radius * radius);
  }
}

using Vector = std::array<long double, 3>;
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
long double inner(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Squared radius and centre of the sphere through the points with its centre in their hull's plane, by elimination.
/// False for dependent points.
bool circumscribed(const std::vector<Vector>& points, Vector& center, long double& square) {
  const std::size_t n = points.size() - 1;
  std::array<std::array<long double, 4>, 3> rows{};
  for (std::size_t i = 0; i < n; ++i) {
    const Vector d = minus(points[i + 1], points[0]);
    for (std::size_t j = 0; j < n; ++j) rows[i][j] = inner(d, minus(points[j + 1], points[0]));
    rows[i][3] = inner(d, d) / 2;
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i; r < n; ++r)
      if (std::abs(rows[r][i]) > std::abs(rows[pivot][i])) pivot = r;
    std::swap(rows[i], rows[pivot]);
    if (std::abs(rows[i][i]) < 1e-14L) return false;
    for (std::size_t r = 0; r < n; ++r) {
      if (r == i) continue;
      const long double factor = rows[r][i] / rows[i][i];
      for (std::size_t c = 0; c < 4; ++c) rows[r][c] -= factor * rows[i][c];
    }
  }
  center = points[0];
  for (std::size_t i = 0; i < n; ++i) {
    const long double weight = rows[i][3] / rows[i][i];
    for (std::size_t k = 0; k < 3; ++k) center[k] += weight * (points[i + 1][k] - points[0][k]);
  }
  const Vector r = minus(center, points[0]);
  square = inner(r, r);
  return true;
}

/// The radius of the smallest sphere around a few points: every set of two, three and four of them is tried. Points of
/// size about 1.
double smallest_radius(const std::vector<Vec3>& points) {
  std::vector<Vector> all;
  for (const Vec3& p : points) all.push_back({p.x, p.y, p.z});
  long double best = std::numeric_limits<long double>::infinity();
  for (unsigned subset = 1; subset < 1u << all.size(); ++subset) {
    if (std::popcount(subset) > 4) continue;
    std::vector<Vector> support;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (subset >> i & 1) support.push_back(all[i]);
    Vector center{};
    long double square = 0;
    if (!circumscribed(support, center, square) || square >= best) continue;
    const bool holds_all = std::all_of(all.begin(), all.end(), [&](const Vector& p) {
      return inner(minus(p, center), minus(p, center)) <= square * (1 + 1e-15L) + 1e-30L;
    });
    if (holds_all) best = square;
  }
  return static_cast<double>(std::sqrt(best));
}

/// A dozen of the points that lie farthest out, as far from each other as can be, bound the radius from below.
void expect_tight(const Sphere& sphere, const std::vector<Vec3>& points) {
  std::vector<Vec3> outmost;
  for (const Vec3& p : points)
    if (norm(p - sphere.center) >= sphere.radius * (1 - 1e-7)) outmost.push_back(p);
  ASSERT_FALSE(outmost.empty());
  const auto distance = [](const Vec3& p, const std::vector<Vec3>& others) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& q : others) least = std::min(least, norm(p - q));
    return least;
  };
  std::vector<Vec3> spread{outmost[0]};
  while (spread.size() < std::min<std::size_t>(outmost.size(), 12))
    spread.push_back(*std::max_element(outmost.begin(), outmost.end(), [&](const Vec3& p, const Vec3& q) {
      return distance(p, spread) < distance(q, spread);
    }));
  EXPECT_LE(sphere.radius, smallest_radius(spread) * (1 + 1e-9) + 1e-15);
}

std::vector<Vec3> random_points(scenes::Random& random, int n, int shape) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    Vec3 p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (shape == 1) p.z = 0;                                                  // coplanar
    if (shape == 2) p = p.x * Vec3{1, 0.5, 0.25};                             // collinear
    if (shape == 3) p = (1 / norm(p)) * p;                                    // all on the border
    if (shape == 4) p = {std::round(p.x), std::round(p.y), std::round(p.z)};  // ties and duplicates
    if (shape == 5) p = Vec3{p.x, 1e-9 * p.y, 1e-13 * p.z};                   // nearly collinear
    points.push_back(p);
  }
  return points;
}

TEST(BoundingSphere, HoldsEveryPointAndIsTheSmallest) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    test::Seeded seeded(seed);
    for (int shape = 0; shape < 6; ++shape) {
      SCOPED_TRACE("shape " + std::to_string(shape));
      const int n = seed % 2 == 0 ? seeded.random.integer(1, 10) : seeded.random.integer(20, 500);
      const std::vector<Vec3> points = random_points(seeded.random, n, shape);
      const Sphere sphere = sphere_of(points);
      expect_holds_all(sphere, points);
      expect_tight(sphere, points);
    }
  }
}

TEST(BoundingSphere, HoldsEveryPointFarAwayTinyAndHuge) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    test::Seeded seeded(seed);
    for (const double scale : {0x1p-300, 0x1p-70, 1.0, 0x1p60, 0x1p290}) {
      const std::vector<Vec3> unit = random_points(seeded.random, 100, static_cast<int>(seed % 6));
      const double radius = sphere_of(unit).radius;
      std::vector<Vec3> points;
      for (const Vec3& p : unit) points.push_back(scale * p);
      const Sphere scaled = sphere_of(points);
      expect_holds_all(scaled, points);
      EXPECT_LE(scaled.radius, scale * radius * (1 + 1e-9));
      for (Vec3& p : points) p = p + scale * Vec3{1e6, -1e6, 3e6};
      const Sphere far = sphere_of(points);
      expect_holds_all(far, points);
      EXPECT_LE(far.radius, scale * (radius + 1e-8));
    }
  }
}

TEST(BoundingSphere, OfKnownShapes) {
  const auto points_of = [](const scenes::MeshData& mesh) {
    const Mesh m = test::mesh_of(mesh);
    return std::vector<Vec3>(m.vertices().begin(), m.vertices().end());
  };
  EXPECT_NEAR(sphere_of(points_of(scenes::cube())).radius, std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(sphere_of(points_of(scenes::uv_sphere(40, 30))).radius, 1, 1e-9);
  EXPECT_NEAR(sphere_of(points_of(scenes::pipe(24, 4, 1, 2, false))).radius, std::sqrt(2.0), 1e-9);
  // An isosceles triangle with an obtuse apex: the centroid and its farthest vertex would give 2.03.
  const std::vector<Vec3> obtuse{{-2, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  EXPECT_NEAR(sphere_of(obtuse).radius, 2, 1e-12);
  EXPECT_EQ(sphere_of({}).radius, 0);
  const std::vector<Vec3> same(9, Vec3{1, 2, 3});
  EXPECT_EQ(sphere_of(same).radius, 0);
  EXPECT_EQ(sphere_of(same).center, (Vec3{1, 2, 3}));
}

/// Against one coordinate after the other, on every instruction set; with numbers of all sizes, zeros, and what is not
/// finite in each place.
TEST(VertexNumbers, AreThoseOfTheCoordinates) {
  test::Seeded seeded(4);
  for (const std::size_t n : {1, 7, 63, 64, 65, 200}) {
    std::vector<Vec3> vertices(n);
    const int reach = seeded.random.integer(0, 1074);
    const auto number = [&] {
      const double x = std::ldexp(seeded.random.uniform(-1, 1), seeded.random.integer(-reach, reach / 2));
      const int kind = seeded.random.integer(0, 9);
      return kind == 0                     ? 0.0
             : kind == 1                   ? -0.0
             : kind == 2                   ? std::ldexp(1.0, std::ilogb(x))
             : kind < 6 && std::abs(x) < 1 ? float(x)
                                           : x;
    };
    for (Vec3& v : vertices) v = {number(), number(), number()};
    Box box{vertices[0], vertices[0]};
    double least = kInfinity, last_place = kInfinity;
    for (const Vec3& v : vertices) {
      box = {min(box.lo, v), max(box.hi, v)};
      for (const double x : {v.x, v.y, v.z}) {
        if (x == 0) continue;
        least = std::min(least, std::abs(x));
        last_place = std::min(last_place, std::ldexp(1.0, lowest_bit(x)));
      }
    }
    for (const std::int64_t set : test::instruction_sets()) {
      const test::OnInstructionSet on(set);
      const scene::VertexNumbers found = scene::vertex_numbers(vertices);
      EXPECT_TRUE(found.is_finite);
      EXPECT_EQ(found.box().lo, box.lo);
      EXPECT_EQ(found.box().hi, box.hi);
      EXPECT_EQ(found.least, least);
      EXPECT_EQ(found.last_place, last_place);
      for (std::size_t i = 0; i < 3 * n; ++i) {
        double& x = i % 3 == 0 ? vertices[i / 3].x : i % 3 == 1 ? vertices[i / 3].y : vertices[i / 3].z;
        const double was = std::exchange(x, i % 2 == 0 ? kInfinity : std::nan(""));
        EXPECT_FALSE(scene::vertex_numbers(vertices).is_finite) << i;
        x = was;
      }
    }
  }
}

}  // namespace
}  // namespace impinge
