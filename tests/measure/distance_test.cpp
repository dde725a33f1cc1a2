// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <thread>

#include "impinge/measures.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Pose moved(double x, double y, double z) { return {.t = {x, y, z}}; }

Nearest ask(const Mesh& a, const Pose& pose_a, const Mesh& b, const Pose& pose_b) {
  auto found = distance(a, pose_a, b, pose_b);
  EXPECT_TRUE(found) << found.error().message;
  return *found;
}

void expect_distance(double expected, const Nearest& found) {
  EXPECT_NEAR(expected, found.distance, found.error + 1e-15 * expected);
  EXPECT_LE(found.error, 1e-10 * (1 + expected));
}

TEST(Distance, OfBoxesIsThatOfTheirFacesEdgesAndCorners) {
  const Mesh cube = test::mesh_of(scenes::cube()), fine = test::mesh_of(scenes::box({0, 0, 0}, {1, 1, 1}, 7));
  for (const Mesh* const other : {&cube, &fine})
    for (const double x : {0.0, 0.25, 3.0, 1000.0}) {
      for (const double y : {0.0, 0.5, 2.0})
        for (const double z : {0.0, 1e-9, 7.0}) {
          if (x + y + z == 0) continue;
          // Gaps that are 0 leave the faces overlapping in that direction.
          const auto at = [](double gap) { return gap == 0 ? 0.125 : 1 + gap; };
          expect_distance(std::sqrt((at(x) - 1) * (at(x) - 1) * (x > 0) + (at(y) - 1) * (at(y) - 1) * (y > 0) +
                                    (at(z) - 1) * (at(z) - 1) * (z > 0)),
                          ask(cube, {}, *other, moved(at(x), at(y), at(z))));
        }
    }
}

TEST(Distance, OfCrossedEdgesIsAlongTheirCommonNormal) {
  // A cube on its edge over a cube: edge over edge at right angles.
  const double h = std::sqrt(0.5);
  const Mesh cube = test::mesh_of(scenes::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
  const Pose about_x{.R = {1, 0, 0, 0, h, -h, 0, h, h}}, about_y{.R = {h, 0, h, 0, 1, 0, -h, 0, h}, .t = {0, 0, 2}};
  const Nearest found = ask(cube, about_x, cube, about_y);
  expect_distance(2 - 2 * h, found);
  EXPECT_NEAR(found.a.x, 0, 1e-12);
  EXPECT_NEAR(found.a.y, 0, 1e-12);
  EXPECT_NEAR(found.a.z, h, 1e-12);
  EXPECT_NEAR(found.b.z, 2 - h, 1e-12);
}

TEST(Distance, OfABoxWithinABoxIsToItsSurface) {
  const Mesh outer = test::mesh_of(scenes::box({-2, -2, -2}, {2, 2, 2}, 3));
  const Mesh inner = test::mesh_of(scenes::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 2));
  expect_distance(1.25, ask(outer, {}, inner, moved(0.25, 0.1, 0)));
}

TEST(Distance, OfSpheresIsBetweenThoseOfTheRoundOnes) {
  const Mesh sphere = test::mesh_of(scenes::uv_sphere(64, 48));
  test::Seeded seeded(5);
  for (int i = 0; i < 10; ++i) {
    const Vec3 v{seeded.random.uniform(1.5, 9), seeded.random.uniform(1, 4), seeded.random.uniform(1, 4)};
    const double gap = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z) - 2;
    const Nearest found = ask(sphere, {}, sphere, moved(v.x, v.y, v.z));
    EXPECT_GE(found.distance, gap - 1e-12);
    EXPECT_LE(found.distance, gap + 0.02);  // no point of the mesh is deeper than 0.01 under the sphere
  }
}

TEST(Distance, IsZeroExactlyWhereMeshesTouch) {
  const auto expect_touching = [](const scenes::PlacedScene& scene, bool touching) {
    const auto meshes = test::meshes_of(scene);
    const auto &a = scene.objects[0], &b = scene.objects[1];
    const Nearest found = ask(meshes[a.mesh], a.pose, meshes[b.mesh], b.pose);
    EXPECT_EQ(found.distance == 0, touching) << found.distance;
    if (touching) {
      EXPECT_EQ(found.error, 0);
    }
  };
  const auto cubes = [](double x, double y, double z) { return scenes::cube_pair({x, y, z}); };
  expect_touching(cubes(1, 0.5, 0.5), true);
  expect_touching(cubes(1, 1, 0), true);
  expect_touching(cubes(1, 1, 1), true);
  expect_touching(cubes(0, 0, 0), true);
  expect_touching(cubes(0.5, 0.5, 0.5), true);
  const double above = std::nextafter(1.0, 2.0);
  expect_touching(cubes(above, 0.5, 0.5), false);
  expect_touching(cubes(above, 1, 1), false);
  expect_touching(scenes::t_junctions(4), true);
  test::Seeded seeded(6);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 30)) {
    SCOPED_TRACE(named.name);
    expect_touching(named.scene, !test::brute_force(named.scene).empty());
  }
}

TEST(Distance, IsTheSameTheOtherWayRound) {
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968)), cube = test::mesh_of(scenes::cube());
  const Nearest one = ask(knot, {}, cube, moved(3.1, 0.2, 0.3)), other = ask(cube, moved(3.1, 0.2, 0.3), knot, {});
  EXPECT_NEAR(one.distance, other.distance, one.error + other.error);
  EXPECT_EQ(one.triangle_a, other.triangle_b);
  EXPECT_EQ(one.triangle_b, other.triangle_a);
  EXPECT_NEAR(one.a.x, other.b.x, 1e-12);
}

TEST(CloserThan, AgreesWithTheDistance) {
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968));
  test::Seeded seeded(7);
  for (int i = 0; i < 20; ++i) {
    const Pose pose = moved(seeded.random.uniform(3, 9), seeded.random.uniform(-4, 4), seeded.random.uniform(-1, 3));
    const Nearest found = ask(knot, {}, knot, pose);
    const auto closer = [&](double limit) { return *closer_than(knot, {}, knot, pose, limit); };
    EXPECT_FALSE(closer(0));
    EXPECT_FALSE(closer(found.distance - 2 * found.error));
    EXPECT_TRUE(closer(found.distance + 2 * found.error + 5e-324));
    EXPECT_TRUE(closer(kInfinity));
  }
  const scenes::PlacedScene touching = scenes::cube_pair({1, 0.5, 0.5});
  const auto meshes = test::meshes_of(touching);
  const auto &a = touching.objects[0], &b = touching.objects[1];
  EXPECT_FALSE(*closer_than(meshes[a.mesh], a.pose, meshes[b.mesh], b.pose, 0));
  EXPECT_TRUE(*closer_than(meshes[a.mesh], a.pose, meshes[b.mesh], b.pose, 5e-324));
}

TEST(Distance, SaysWhatIsWrong) {
  const Mesh cube = test::mesh_of(scenes::cube()), none = test::mesh_of({});
  const auto code = [](const auto& result) { return result.has_value() ? -1 : static_cast<int>(result.error().code); };
  const auto is = [](Code c) { return static_cast<int>(c); };
  EXPECT_EQ(code(distance(cube, {}, none, {})), is(Code::bad_mesh));
  EXPECT_EQ(code(distance(none, {}, cube, {})), is(Code::bad_mesh));
  EXPECT_EQ(code(distance(cube, {.R = {2, 0, 0, 0, 1, 0, 0, 0, 1}}, cube, {})), is(Code::bad_pose));
  EXPECT_EQ(code(distance(cube, {}, cube, moved(0, std::nan(""), 0))), is(Code::bad_pose));
  EXPECT_EQ(code(distance(cube, {}, cube, moved(0, 1e200, 0))), is(Code::out_of_range));
  EXPECT_EQ(code(distance(cube, {}, cube, {}, {.threads = -1})), is(Code::bad_option));
  EXPECT_EQ(code(closer_than(cube, {}, cube, {}, -1)), is(Code::bad_option));
  EXPECT_EQ(code(closer_than(cube, {}, cube, {}, std::nan(""))), is(Code::bad_option));
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(code(distance(cube, {}, cube, {}, {.stop = source.get_token()})), is(Code::cancelled));
}

TEST(Distance, OfTheFarthestAndTheSmallest) {
  const Mesh cube = test::mesh_of(scenes::cube());
  expect_distance(0x1p299 - 1, ask(cube, {}, cube, moved(0x1p299, 0, 0)));
  for (const double scale : {0x1p-340, 0x1p-100, 0x1p200, 0x1p296}) {
    const Mesh scaled = test::mesh_of(scenes::scaled(scenes::cube(), scale, scale, scale));
    const Nearest found = ask(scaled, {}, scaled, moved(2.5 * scale, 0, 2 * scale));
    EXPECT_NEAR(found.distance / scale, std::sqrt(1.5 * 1.5 + 1), 1e-12);
    EXPECT_LE(found.error / scale, 1e-12);
  }
  const Mesh tiny = test::mesh_of(scenes::scaled(scenes::cube(), 0x1p-300, 0x1p-300, 0x1p-300));
  const Nearest found = ask(cube, {}, tiny, moved(2, 0.5, 0.5));
  EXPECT_NEAR(found.distance, 1, 1e-12);
}

/// A position that is smoothed towards 0 gets there by way of every double.
TEST(Distance, OfPositionsFinerThanTheExactDomain) {
  const Mesh cube = test::mesh_of(scenes::cube());
  const Mesh corner = test::mesh_of({{0, 0, 0, -1, 0, 0, -1, 1, 0, -1, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}});
  const Mesh point = test::mesh_of({{0, 0, 0, 0, 0, 0, 0, 0, 0}, {0, 1, 2}});
  for (const double fine : {0x1p-306, 0x1p-359, 0x1.8p-700, 0x1p-1022, 0x1.8p-1030, 5e-324}) {
    for (const Pose& at : {moved(fine, 0.5, 0.5), moved(-fine, 0.5, 0.5), moved(2, fine, -fine)}) {
      // The cube's coordinates, 0 and 1, swallow `fine` or become it.
      const double gap = at.t[0] == 2 ? 1 : std::max(0.0, at.t[0] - 1);
      expect_distance(gap, ask(cube, {}, cube, at));
      EXPECT_EQ(ask(cube, {}, cube, at).distance == 0, gap == 0);
    }
    for (const Mesh* const mesh : {&corner, &point}) {
      EXPECT_EQ(ask(*mesh, {}, cube, moved(0, -0.5, -0.5)).distance, 0);
      const Nearest found = ask(*mesh, {}, cube, moved(fine, -0.5, -0.5));
      EXPECT_GT(found.distance, 0);
      EXPECT_NEAR(found.distance, fine, found.error);
      EXPECT_LE(found.error, 1e-12);
      EXPECT_FALSE(*closer_than(*mesh, {}, cube, moved(1 + fine, -0.5, -0.5), 0.5));
    }
    const Nearest between = ask(point, {}, point, moved(fine, 0, 0));
    EXPECT_GT(between.distance, 0);
    EXPECT_NEAR(between.distance, fine, between.error);
    EXPECT_LE(between.error, 4 * fine);
  }
}

TEST(Distance, ObeysTheCallersModeAndLeavesIt) {
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968));
  const Nearest plain = ask(knot, {}, knot, moved(7, 0, 0));
  const Mesh again = test::mesh_of(scenes::torus_knot_of(968));
  const test::CallersMode mode(FE_UPWARD, true);
  const auto found = distance(again, {}, again, moved(7, 0, 0));
  EXPECT_TRUE(mode.is_untouched());
  EXPECT_EQ(found->distance, plain.distance);
}

TEST(Distance, IsTheSameFromManyThreads) {
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(9612));
  const Nearest expected = ask(test::mesh_of(scenes::torus_knot_of(9612)), {}, knot, moved(7, 0.3, 0));
  const Mesh fresh = test::mesh_of(scenes::torus_knot_of(9612));
  std::vector<std::jthread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      const auto found = distance(fresh, {}, fresh, moved(7, 0.3, 0));
      EXPECT_EQ(found->distance, expected.distance);
      EXPECT_EQ(found->triangle_a, expected.triangle_a);
    });
}

}  // namespace
}  // namespace impinge
