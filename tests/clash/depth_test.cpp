// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Overlap depths against shapes whose depth is known, and against many points of the boundary.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "impinge/measures.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::MeshData;

Mesh box(const std::array<double, 3>& low, const std::array<double, 3>& high, int n = 1) {
  return test::mesh_of(scenes::box(low, high, n));
}

void expect_holds(const Interval& interval, double depth, double precision = 0.01) {
  EXPECT_LE(interval.lo, depth * (1 + 1e-12));
  EXPECT_GE(interval.hi, depth * (1 - 1e-12));
  EXPECT_LE(interval.hi - interval.lo, precision * interval.hi + 1e-12);
}

void expect_depths(double a_in_b, double b_in_a, const Mesh& a, const Mesh& b, const Pose& pose = {}) {
  for (const double precision : {0.1, 0.001}) {
    const auto depth = overlap_depth(a, pose, b, pose, precision);
    ASSERT_TRUE(depth) << depth.error().message;
    expect_holds(depth->a_in_b, a_in_b, precision);
    expect_holds(depth->b_in_a, b_in_a, precision);
    const auto swapped = overlap_depth(b, pose, a, pose, precision);
    ASSERT_TRUE(swapped);
    expect_holds(swapped->b_in_a, a_in_b, precision);
    expect_holds(swapped->a_in_b, b_in_a, precision);
  }
}

TEST(OverlapDepth, OfBoxesAtACorner) {
  expect_depths(0.25, 0.25, box({0, 0, 0}, {1, 1, 1}), box({0.75, 0.75, 0.75}, {1.75, 1.75, 1.75}));
  expect_depths(0.25, 0.25, box({0, 0, 0}, {1, 1, 1}, 5), box({0.75, 0.75, 0.75}, {1.75, 1.75, 1.75}, 3));
}

TEST(OverlapDepth, OfARodThroughAPlate) {
  const Mesh rod = box({-0.25, -0.25, -4}, {0.25, 0.25, 4}), plate = box({-2, -2, -0.5}, {2, 2, 0.5});
  expect_depths(0.5, 0.25, rod, plate);
  test::Seeded seeded(7);
  for (int i = 0; i < 4; ++i) {
    const Pose motion = scenes::random_motion(seeded.random, 10);
    const auto depth = overlap_depth(rod, motion, plate, motion);
    ASSERT_TRUE(depth);
    EXPECT_LE(depth->a_in_b.lo, 0.5 + 1e-12);
    EXPECT_GE(depth->a_in_b.hi, 0.5 - 1e-12);
    EXPECT_LE(depth->b_in_a.lo, 0.25 + 1e-12);
    EXPECT_GE(depth->b_in_a.hi, 0.25 - 1e-12);
  }
}

TEST(OverlapDepth, OfNestedBoxes) {
  expect_depths(1, 0, box({1, 1, 1}, {2, 2, 2}), box({0, 0, 0}, {3, 3, 3}));
  expect_depths(0.5, 0, test::mesh_of(scenes::inverted(scenes::box({0.5, 0.5, 0}, {1, 1, 1}))),
                box({0, 0, 0}, {1.5, 1.5, 1.5}));
}

TEST(OverlapDepth, IsNothingWhereNothingReachesIn) {
  const Mesh cube = box({0, 0, 0}, {1, 1, 1});
  expect_depths(0, 0, cube, box({5, 0, 0}, {6, 1, 1}));
  expect_depths(0, 0, cube, box({1, 0, 0}, {2, 1, 1}));
  expect_depths(0, 0, cube, box({1, 0.25, 0.25}, {2, 0.5, 0.5}, 3));
  expect_depths(0, 0, cube, cube);
}

TEST(OverlapDepth, OfThinSheetsInEachOther) {
  expect_depths(0.125, 0.125, box({0, 0, 0}, {4, 4, 0.5}), box({0, 0, 0.375}, {4, 4, 0.875}));
}

TEST(OverlapDepth, FarAwayAndOfAnySize) {
  const auto depths = [](double size, double away) {
    const Mesh a = box({away, away, away}, {away + size, away + size, away + size});
    const Mesh b = box({away + size / 2, away, away}, {away + 2 * size, away + size, away + size});
    const auto depth = overlap_depth(a, {}, b, {}, 0.01);
    ASSERT_TRUE(depth);
    EXPECT_LE(depth->a_in_b.lo, size / 2);
    EXPECT_GE(depth->a_in_b.hi, size / 2);
    EXPECT_GE(depth->a_in_b.lo, 0.4 * size);
  };
  depths(1, 0), depths(1, 0x1p20), depths(0x1p-200, 0), depths(0x1p200, 0);
}

/// Points spread over the triangles say how deep it is at least; none may be deeper than the interval says.
TEST(OverlapDepth, HoldsWhatManyPointsSay) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    test::Seeded seeded(seed);
    const MeshData knot = scenes::torus_knot_of(968);
    const Mesh a = test::mesh_of(knot), b = test::mesh_of(scenes::uv_sphere(16, 12, 1.5));
    const Pose pose_a = scenes::random_motion(seeded.random, 1), pose_b = scenes::random_motion(seeded.random, 1);
    const auto depth = overlap_depth(a, pose_a, b, pose_b, 0.02);
    ASSERT_TRUE(depth);
    expect_holds(depth->a_in_b, std::clamp(depth->a_in_b.lo, 0.0, depth->a_in_b.hi), 0.02);
    double deepest = 0;
    for (const auto& [i, j, k] : a.triangles()) {
      const Point p = world_vertex(pose_a, a.vertices()[i]), q = world_vertex(pose_a, a.vertices()[j]),
                  r = world_vertex(pose_a, a.vertices()[k]);
      for (const auto& [u, v] : {std::pair(1.0 / 3, 1.0 / 3), std::pair(0.0, 0.0), std::pair(0.5, 0.5)}) {
        const double w = 1 - u - v;
        const Point x{u * p.x + v * q.x + w * r.x, u * p.y + v * q.y + w * r.y, u * p.z + v * q.z + w * r.z};
        if (locate(x, b, pose_b).value() != Location::inside) continue;
        const Mesh point = test::mesh_of({{x.x, x.y, x.z}, {0, 0, 0}});
        deepest = std::max(deepest, distance(point, {}, b, pose_b).value().distance);
      }
    }
    EXPECT_LE(deepest, depth->a_in_b.hi + 1e-9) << "seed " << seed;
    EXPECT_GE(deepest, 0.9 * depth->a_in_b.lo) << "seed " << seed;
    EXPECT_GT(deepest, 0) << "seed " << seed;
  }
}

TEST(OverlapDepth, SaysWhatItCannotTake) {
  const Mesh cube = box({0, 0, 0}, {1, 1, 1});
  const Mesh open = test::mesh_of(scenes::opened(scenes::cube()));
  EXPECT_EQ(overlap_depth(open, {}, cube, {}).error().code, Code::bad_mesh);
  EXPECT_EQ(overlap_depth(cube, {}, open, {}).error().code, Code::bad_mesh);
  for (const double precision : {0.0, -1.0, 1.5, std::nan("")})
    EXPECT_EQ(overlap_depth(cube, {}, cube, {}, precision).error().code, Code::bad_option);
  EXPECT_EQ(overlap_depth(cube, {.R = {2, 0, 0, 0, 1, 0, 0, 0, 1}}, cube, {}).error().code, Code::bad_pose);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(overlap_depth(cube, {}, cube, {}, 0.01, {.stop = stop.get_token()}).error().code, Code::cancelled);
}

}  // namespace
}  // namespace impinge
