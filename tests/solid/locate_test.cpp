// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/locate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "impinge/measures.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/oracle/points.hpp"
#include "tests/solid/placed.hpp"
#include "tests/solid/winding_oracle.hpp"

namespace impinge {
namespace {

using scenes::Random;

exact::RationalPoint ours(const oracle::Vec& p) {
  return {exact::Rational(p[0].get_str()), exact::Rational(p[1].get_str()), exact::Rational(p[2].get_str())};
}

/// A placed mesh and the same triangles as rational numbers.
struct Placed {
  Mesh mesh;
  Pose pose;
  std::vector<Triangle> world;
  oracle::Triangles exact;

  Placed(const scenes::MeshData& numbers, const Pose& at, std::uint32_t leaf_size)
      : mesh(test::mesh_of(numbers, leaf_size)), pose(at), world(test::world_triangles(mesh, at)) {
    for (const Triangle& t : world) exact.push_back({points::exact(t[0]), points::exact(t[1]), points::exact(t[2])});
  }
  [[nodiscard]] hierarchy::PlacedTree tree() const { return mesh.state().placed(pose); }
};

std::optional<int> expected(const Placed& body, const oracle::Vec& p, Random& random) {
  return oracle::winding_number(body.exact, p, [&] { return random.integer(-1000000, 1000000); });
}

void expect_agrees(const Placed& body, const Point& p, Random& random) {
  SCOPED_TRACE(testing::Message() << std::hexfloat << p.x << ' ' << p.y << ' ' << p.z);
  const oracle::Vec exact = points::exact(p);
  ASSERT_EQ(solid::winding_number(body.tree(), p), expected(body, exact, random));
}

void expect_agrees(const Placed& body, const oracle::Vec& p, Random& random) {
  SCOPED_TRACE(testing::Message() << p[0] << ' ' << p[1] << ' ' << p[2]);
  const solid::Around found = solid::around(body.tree(), ours(p));
  ASSERT_EQ(found.holders.empty() ? std::optional(found.beside) : std::nullopt, expected(body, p, random));
}

/// Closed whatever the corners: tetrahedra of either orientation, some of them flat, on the integers [-side, side].
scenes::MeshData tetrahedra(Random& random, int n, int side) {
  scenes::MeshData whole;
  const auto point = points::integers(-side, side);
  for (int i = 0; i < n; ++i)
    whole = scenes::joined(whole, test::tetrahedron({point(random), point(random), point(random), point(random)}));
  return whole;
}

std::vector<Pose> poses(Random& random) {
  Pose far, off = scenes::random_motion(random, 1);
  far.t = {1e6, -3e6, 2e6};
  off.R = scenes::stretched_rotation(random, 9e-7);
  Pose off_far = off;
  off_far.t = {-1e6, 1e6, 1e6};
  return {{}, far, scenes::random_motion(random, 10), off, off_far};
}

/// Points on a triangle, and as near to it as doubles are.
std::vector<Point> near_triangle(const Triangle& t, Random& random) {
  const double s = random.unit(), u = random.unit() * (1 - s);
  const Point mixed = t[0] + s * (t[1] - t[0]) + u * (t[2] - t[0]);
  // Zero stays: its neighbours lie outside the domain.
  const auto step = [&](double x) {
    return x == 0 ? x : std::nextafter(x, random.integer(0, 1) == 0 ? -1e300 : 1e300);
  };
  return {t[0],
          {step(t[1].x), t[1].y, t[1].z},
          mixed,
          {step(mixed.x), step(mixed.y), mixed.z},
          {mixed.x + random.uniform(-2, 2), mixed.y, mixed.z}};
}

TEST(WindingNumber, OfLatticePointsIsWhatRaysInGeneralDirectionsCount) {
  for (std::uint64_t seed = 1; seed <= 30u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const int side = random.integer(1, 3);
    const Placed body(tetrahedra(random, random.integer(1, 8), side), {}, seed % 2 == 0 ? 1 : 0);
    for (int i = 0; i < 40; ++i) {
      const Point p = points::integers(-2 * side, 2 * side)(random);
      ASSERT_NO_FATAL_FAILURE(expect_agrees(body, 0.5 * p, random));
    }
  }
}

TEST(WindingNumber, OfRationalPointsIsWhatRaysInGeneralDirectionsCount) {
  for (std::uint64_t seed = 1; seed <= 30u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const Placed body(tetrahedra(random, random.integer(1, 8), 2), poses(random)[seed % 5], seed % 2 == 0 ? 1 : 0);
    for (int i = 0; i < 20; ++i) {
      // On a triangle, or along the ray's axis from there by a third of nearly nothing, or anywhere.
      const auto& t = body.exact[static_cast<std::size_t>(random.integer(0, static_cast<int>(body.exact.size()) - 1))];
      const auto ratio = [](int p, const mpz_class& q) {
        mpq_class x(p, q);
        x.canonicalize();
        return x;
      };
      const mpq_class s = ratio(random.integer(0, 3), 3), u = ratio(random.integer(0, 7), 7) * (1 - s);
      oracle::Vec p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = t[0][k] + s * (t[1][k] - t[0][k]) + u * (t[2][k] - t[0][k]);
      const mpq_class nearly_nothing = ratio(random.integer(-1, 1), mpz_class(3) << random.integer(0, 200));
      if (i % 2 == 0) p[static_cast<std::size_t>(i / 2 % 3)] += nearly_nothing;
      ASSERT_NO_FATAL_FAILURE(expect_agrees(body, p, random));
    }
  }
}

TEST(WindingNumber, IsExactOnPlacedMeshesOfEverySize) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const double size = std::array{1.0, 0x1p-70, 0x1p60, 1e-7}[seed % 4];
    const std::array shapes{scenes::uv_sphere(8, 6, size),
                            scenes::scaled(scenes::box({0, 0, 0}, {1, 2, 3}, 3), size, size, size),
                            scenes::scaled(scenes::torus_knot(2, 3, 12, 5), size, size, size),
                            scenes::scaled(tetrahedra(random, 12, 3), size, size, size)};
    for (const scenes::MeshData& shape : shapes)
      for (const Pose& pose : poses(random)) {
        const Placed body(shape, pose, seed % 2 == 0 ? 1 : 0);
        for (int i = 0; i < 4; ++i) {
          const auto k = static_cast<std::size_t>(random.bits() % body.world.size());
          for (const Point& p : near_triangle(body.world[k], random))
            ASSERT_NO_FATAL_FAILURE(expect_agrees(body, p, random));
        }
      }
  }
}

/// Rays along edges, through vertices and within faces.
TEST(WindingNumber, OfShellsInShells) {
  Random random(1);
  const auto box = [](double half, int n) { return scenes::box({-half, -half, -half}, {half, half, half}, n); };
  const Placed nested(
      scenes::joined(scenes::joined(box(3, 3), scenes::inverted(box(2, 2))), scenes::joined(box(1, 1), box(0.5, 1))),
      {}, 0);
  EXPECT_EQ(solid::winding_number(nested.tree(), Point{-2.5, 0, 0}), 1);
  EXPECT_EQ(solid::winding_number(nested.tree(), Point{-1.5, 0, 0}), 0);
  EXPECT_EQ(solid::winding_number(nested.tree(), Point{0, 0, 0}), 2);
  EXPECT_EQ(solid::winding_number(nested.tree(), Point{-4, 0, 0}), 0);
  EXPECT_EQ(solid::winding_number(nested.tree(), Point{-3, 1, 1}), std::nullopt);
  for (int x = -8; x <= 8; ++x)
    for (int y = -8; y <= 8; ++y)
      ASSERT_NO_FATAL_FAILURE(expect_agrees(nested, Point{x / 2.0, y / 2.0, random.integer(-8, 8) / 2.0}, random));
  const Placed alone(scenes::inverted(box(1, 2)), {}, 0);
  EXPECT_EQ(solid::winding_number(alone.tree(), Point{0, 0, 0}), -1);
}

TEST(WindingNumber, DegenerateTrianglesHoldPointsAndCountNothing) {
  for (std::uint64_t seed = 1; seed <= 20u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const Placed body(scenes::joined(scenes::box({0, 0, 0}, {3, 3, 3}, 1), scenes::degenerate_soup(random, 20, 4)), {},
                      0);
    for (int i = 0; i < 40; ++i) ASSERT_NO_FATAL_FAILURE(expect_agrees(body, points::integers(-1, 5)(random), random));
  }
}

TEST(WindingNumber, ReachesTheEndsOfTheDomain) {
  Random random(1);
  const Placed body(scenes::scaled(scenes::box({-1, -1, -1}, {1, 1, 1}, 2), 0x1p299, 0x1p-357, 1), {}, 0);
  for (const double x : {-0x1.8p299, -0x1p298, 0.0, 0x1p-358})
    for (const double y : {-0x1p-357, -0x1p-358, 0.0, 0x1p-357, 0x1p-356})
      for (const double z : {-1.0, 0.0, 0.5}) ASSERT_NO_FATAL_FAILURE(expect_agrees(body, Point{x, y, z}, random));
}

/// p + (e³, e, e²), with an e that is small enough for small integers.
TEST(Around, IsTheWindingNumberBesideThePointAndWhatHoldsIt) {
  const mpq_class e(1, mpz_class(1) << 100);
  for (std::uint64_t seed = 1; seed <= 30u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const Placed body(tetrahedra(random, random.integer(1, 6), 2), {}, 0);
    for (int i = 0; i < 30; ++i) {
      const Point p = 0.5 * points::integers(-4, 4)(random);
      const oracle::Vec exact = points::exact(p);
      const oracle::Vec beside{exact[0] + e * e * e, exact[1] + e, exact[2] + e * e};
      const solid::Around found = solid::around(body.tree(), p);
      ASSERT_EQ(std::optional(found.beside), expected(body, beside, random));
      std::set<std::uint32_t> holders;
      for (std::uint32_t t = 0; t < body.exact.size(); ++t)
        if (oracle::holds(body.exact[t], exact)) holders.insert(t);
      ASSERT_EQ(std::set<std::uint32_t>(found.holders.begin(), found.holders.end()), holders);
      ASSERT_EQ(found.holders.size(), holders.size());
    }
  }
}

TEST(Rational, IsWhatItWasMadeOfAndRoundsNearby) {
  for (std::uint64_t seed = 1; seed <= 2000u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const double x = points::anywhere(random), y = points::anywhere(random);
    const mpq_class exact_x(x), exact_y(y);
    EXPECT_EQ(exact::Rational(x), exact::Rational(exact_x.get_str()));
    EXPECT_EQ(exact::rounded(exact::Rational(x)), x);
    if (y == 0) continue;
    const mpq_class quotient = exact_x / exact_y, near(exact::rounded(exact::Rational(x) / exact::Rational(y)));
    EXPECT_LE(abs(near - quotient) * (mpz_class(1) << 52), abs(quotient));
  }
}

TEST(Locate, TellsInsideOutsideAndBoundary) {
  const Mesh cube = test::mesh_of(scenes::cube());
  EXPECT_EQ(*locate({0.5, 0.5, 0.5}, cube), Location::inside);
  EXPECT_EQ(*locate({0.5, 0.5, 1}, cube), Location::boundary);
  EXPECT_EQ(*locate({0.5, 0.5, std::nextafter(1, 2)}, cube), Location::outside);
  EXPECT_EQ(*locate({0.5, 0.5, std::nextafter(1, 0)}, cube), Location::inside);
  EXPECT_EQ(*locate({-1, 0, 0}, cube), Location::outside);
  EXPECT_EQ(*locate({10.5, 0.5, 0.5}, cube, {.t = {10, 0, 0}}), Location::inside);
  EXPECT_EQ(*locate({0.5, 0.5, 5e-324}, cube), Location::inside);
  EXPECT_EQ(*locate({0.5, 0.5, -5e-324}, cube), Location::outside);
  EXPECT_EQ(*locate({0.5, 0.5, 5e-324}, cube, {.t = {0, 0, 1e-323}}), Location::outside);
  EXPECT_EQ(*locate({0.5, 0.5, 0.5}, test::mesh_of(scenes::inverted(scenes::cube()))), Location::inside);
}

/// Of solids at rest and moved, flat ones, shells in shells and what meets itself: points everywhere, on vertices, on
/// edges and an ulp beside, as `locate` has them one by one; known cells and unknown ones, on one thread and on many.
TEST(PointLocator, HasWhatLocateHas) {
  test::Seeded seeded(3);
  Random& random = seeded.random;
  scenes::MeshData nested = scenes::box({0, 0, 0}, {4, 4, 4}, 3);
  for (const scenes::MeshData& inner : {scenes::inverted(scenes::box({1, 1, 1}, {3, 3, 3}, 2)), scenes::cube(),
                                        scenes::shifted(scenes::cube(), 0.5, 0.5, 0.5)})
    nested = scenes::joined(nested, inner);
  const std::vector<scenes::MeshData> shapes{scenes::torus_knot_of(968), scenes::cube(), nested,
                                             scenes::scaled(scenes::uv_sphere(16, 16), 1, 1e-3, 100),
                                             scenes::scaled(scenes::uv_sphere(16, 16), 1e-9, 1e-9, 1e-9)};
  for (const scenes::MeshData& shape : shapes) {
    const Mesh mesh = test::mesh_of(shape);
    for (const Pose& pose : {Pose{}, scenes::random_motion(random, 1e3)}) {
      const PointLocator locator = PointLocator::create(mesh, pose).value();
      std::vector<Point> points;
      const auto vertex = [&] {
        const int i = random.integer(0, static_cast<int>(mesh.vertex_count()) - 1);
        return world_vertex(pose, mesh.vertices()[static_cast<std::size_t>(i)]);
      };
      for (int i = 0; i < 150; ++i) {
        const Vec3 p = vertex(), q = vertex();
        const double s = random.uniform(-0.2, 1.2);
        points.insert(points.end(), {p + s * (q - p), p, 0.5 * p + 0.5 * q, {std::nextafter(p.x, q.x), p.y, q.z}});
      }
      points.push_back({1e9, 0, 0});
      std::vector<Location> expected;
      for (const Point& p : points) expected.push_back(locate(p, mesh, pose).value());
      EXPECT_EQ(locator.locate(points, {.threads = 1}).value(), expected);
      EXPECT_EQ(locator.locate(points).value(), expected);
      for (const Location some : {Location::inside, Location::outside, Location::boundary})
        EXPECT_GT(std::count(expected.begin(), expected.end(), some), 5);
    }
  }
}

TEST(PointLocator, RefusesWhatLocateRefuses) {
  const auto code = [](const auto& result) { return result ? std::nullopt : std::optional(result.error().code); };
  const Mesh cube = test::mesh_of(scenes::cube());
  EXPECT_EQ(code(PointLocator::create(test::mesh_of(scenes::flat_grid(1, 1)))), Code::bad_mesh);
  EXPECT_EQ(code(PointLocator::create(test::mesh_of({}))), Code::bad_mesh);
  EXPECT_EQ(code(PointLocator::create(cube, {.R = {2, 0, 0, 0, 1, 0, 0, 0, 1}})), Code::bad_pose);
  EXPECT_EQ(code(PointLocator::create(cube, {.t = {0x1p301, 0, 0}})), Code::out_of_range);
  EXPECT_EQ(code(PointLocator::create(cube, {}, -1)), Code::bad_option);
  const PointLocator locator = PointLocator::create(cube).value();
  EXPECT_EQ(locator.locate({}).value().size(), 0u);
  const std::vector<Point> points{{0, 0, 0}, {0, std::nan(""), 0}};
  const auto wrong = locator.locate(points);
  EXPECT_EQ(code(wrong), Code::out_of_range);
  EXPECT_NE(wrong.error().message.find("points[1]"), std::string::npos);
  EXPECT_EQ(code(locator.locate(points, {.threads = -1})), Code::bad_option);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(code(locator.locate({points.data(), 1}, {.stop = stop.get_token()})), Code::cancelled);
}

TEST(Locate, RefusesWhatHasNoInside) {
  const auto code = [](const Result<Location>& result) {
    return result ? std::nullopt : std::optional(result.error().code);
  };
  const Mesh cube = test::mesh_of(scenes::cube());
  EXPECT_EQ(code(locate({0, 0, 0}, test::mesh_of(scenes::flat_grid(1, 1)))), Code::bad_mesh);
  EXPECT_EQ(code(locate({0, 0, 0}, test::mesh_of({}))), Code::bad_mesh);
  EXPECT_EQ(code(locate({0, 0, 0}, cube, {.R = {2, 0, 0, 0, 1, 0, 0, 0, 1}})), Code::bad_pose);
  EXPECT_EQ(code(locate({0, 0, 0}, cube, {.t = {0x1p301, 0, 0}})), Code::out_of_range);
  EXPECT_EQ(code(locate({0, std::nan(""), 0}, cube)), Code::out_of_range);
  EXPECT_EQ(code(locate({0, 0, 0x1p300}, cube)), Code::out_of_range);
}

}  // namespace
}  // namespace impinge
