// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Overlap depths against shapes whose depth is known, and against many points of the boundary.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "impinge/measures.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::MeshData;
using scenes::regular;

Mesh box(const std::array<double, 3>& low, const std::array<double, 3>& high, int n = 1) {
  return test::mesh_of(scenes::box(low, high, n));
}

void expect_holds(const Interval& interval, double depth, double precision = 0.01) {
  EXPECT_LE(interval.lo, depth * (1 + 1e-12));
  EXPECT_GE(interval.hi, depth * (1 - 1e-12));
  EXPECT_LE(interval.hi - interval.lo, precision * depth + 1e-12);
}

void expect_depths(double a_in_b, double b_in_a, const Mesh& a, const Mesh& b, const Pose& pose = {}) {
  for (const double precision : {0.5, 0.1, 0.001}) {
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

constexpr double kRounding = 0x1p-41;  ///< of the largest coordinate: what a depth that is nothing may be given as

double largest_coordinate(const Mesh& mesh, const Pose& pose) {
  double largest = 0;
  for (const Point& v : mesh.vertices()) {
    const Point p = world_vertex(pose, v);
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return largest;
}

/// Both meshes moved by a few motions, by pose and with baked vertices. The depths are those of the meshes, up to the
/// rounding of the moved vertices.
void expect_depths_when_moved(double a_in_b, double b_in_a, const MeshData& a, const MeshData& b, std::uint64_t seed) {
  test::Seeded seeded(seed);
  for (const double reach : {1.0, 50.0}) {
    const Pose motion = scenes::random_motion(seeded.random, reach);
    for (const bool baked : {false, true}) {
      const Mesh mesh_a = test::mesh_of(baked ? scenes::baked(a, motion) : a);
      const Mesh mesh_b = test::mesh_of(baked ? scenes::baked(b, motion) : b);
      const Pose pose = baked ? Pose{} : motion;
      const auto depth = overlap_depth(mesh_a, pose, mesh_b, pose, 0.01);
      ASSERT_TRUE(depth) << depth.error().message;
      const double rounding = kRounding * std::max(largest_coordinate(mesh_a, pose), largest_coordinate(mesh_b, pose));
      const auto expect = [&](const Interval& interval, double truth) {
        EXPECT_LE(interval.lo, truth + rounding);
        EXPECT_GE(interval.hi, truth - rounding);
        EXPECT_LE(interval.hi - interval.lo, 0.01 * interval.hi + rounding);
      };
      expect(depth->a_in_b, a_in_b), expect(depth->b_in_a, b_in_a);
    }
  }
}

/// c + a u + b v
struct Linear {
  double c, a, b;
  [[nodiscard]] double at(double u, double v) const { return c + a * u + b * v; }
};

/// The distances from the planes of a convex solid, positive within, over a triangle p + u (q - p) + v (r - p); of
/// triangles in one plane once.
std::vector<Linear> depths_over(const Point& p, const Point& q, const Point& r, const Mesh& convex, const Pose& pose) {
  std::vector<Linear> depths;
  for (const auto& [i, j, k] : convex.triangles()) {
    const Point a = world_vertex(pose, convex.vertices()[i]), b = world_vertex(pose, convex.vertices()[j]),
                c = world_vertex(pose, convex.vertices()[k]);
    const double nx = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
    const double ny = (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z);
    const double nz = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const double length = std::hypot(nx, ny, nz);
    const auto below = [&](const Point& x) {
      return (nx * (a.x - x.x) + ny * (a.y - x.y) + nz * (a.z - x.z)) / length;
    };
    const Linear depth{below(p), below(q) - below(p), below(r) - below(p)};
    const auto is_same = [&](const Linear& d) {
      return std::abs(d.c - depth.c) + std::abs(d.a - depth.a) + std::abs(d.b - depth.b) < 1e-12;
    };
    if (std::none_of(depths.begin(), depths.end(), is_same)) depths.push_back(depth);
  }
  return depths;
}

/// In a convex solid the depth of a point is the least of its distances from the planes. Its maximum over a triangle
/// is at a corner, or where it meets an edge in, or three planes at, one distance: all of these are looked at.
double depth_in_convex(const Mesh& inner, const Pose& pose_inner, const Mesh& convex, const Pose& pose_convex) {
  double deepest = 0;
  for (const auto& [i, j, k] : inner.triangles()) {
    const Point p = world_vertex(pose_inner, inner.vertices()[i]), q = world_vertex(pose_inner, inner.vertices()[j]),
                r = world_vertex(pose_inner, inner.vertices()[k]);
    const std::vector<Linear> depths = depths_over(p, q, r, convex, pose_convex);
    std::vector<Linear> lines{{0, 1, 0}, {0, 0, 1}, {1, -1, -1}};
    for (std::size_t x = 0; x < depths.size(); ++x)
      for (std::size_t y = 0; y < x; ++y)
        lines.push_back({depths[x].c - depths[y].c, depths[x].a - depths[y].a, depths[x].b - depths[y].b});
    for (std::size_t x = 0; x < lines.size(); ++x)
      for (std::size_t y = 0; y < x; ++y) {
        const Linear &f = lines[x], &g = lines[y];
        const double determinant = f.a * g.b - f.b * g.a;
        if (std::abs(determinant) < 1e-14) continue;
        const double u = (f.b * g.c - f.c * g.b) / determinant, v = (f.c * g.a - f.a * g.c) / determinant;
        if (u < -1e-12 || v < -1e-12 || u + v > 1 + 1e-12) continue;
        double depth = depths.front().at(u, v);
        for (const Linear& d : depths) depth = std::min(depth, d.at(u, v));
        deepest = std::max(deepest, depth);
      }
  }
  return deepest;
}

TEST(OverlapDepth, OfBoxesAtACorner) {
  expect_depths(0.25, 0.25, box({0, 0, 0}, {1, 1, 1}), box({0.75, 0.75, 0.75}, {1.75, 1.75, 1.75}));
  expect_depths(0.25, 0.25, box({0, 0, 0}, {1, 1, 1}, 5), box({0.75, 0.75, 0.75}, {1.75, 1.75, 1.75}, 3));
}

TEST(OverlapDepth, OfARodThroughAPlate) {
  const MeshData rod = scenes::box({-0.25, -0.25, -4}, {0.25, 0.25, 4}),
                 plate = scenes::box({-2, -2, -0.5}, {2, 2, 0.5});
  expect_depths(0.5, 0.25, test::mesh_of(rod), test::mesh_of(plate));
  expect_depths_when_moved(0.5, 0.25, rod, plate, 7);
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

/// Flush faces cross by an ulp once they are moved, and nothing but roundings is deep.
TEST(OverlapDepth, OfFlushFacesIsNothingWhenMoved) {
  const MeshData plate = scenes::box({-3, -3, -1}, {3, 3, 0});
  for (const int sides : {5, 16, 50}) {
    expect_depths_when_moved(0, 0, plate, scenes::pipe(sides, 1, 1, 2, true), 31);
    expect_depths_when_moved(0, 0, scenes::box({-3, -3, -1}, {3, 3, 0}, 4), scenes::prism(regular(sides, 1), 0, 2), 32);
    expect_depths_when_moved(0, 0, scenes::ring(regular(sides, 2), regular(sides, 1), 0, 1),
                             scenes::prism(regular(sides, 1), -1, 2), 33);
  }
  expect_depths_when_moved(0, 0, scenes::box({0, 0, 0}, {1, 1, 1}, 5), scenes::box({0, 0, 1}, {1, 1, 2}, 7), 34);
  expect_depths_when_moved(0, 0, scenes::box({0, 0, 0}, {1, 1, 1}, 3), scenes::box({0.3, 0.4, 1}, {1.3, 1.4, 2}, 4),
                           35);
  expect_depths_when_moved(0, 0, scenes::box({0, 0, 0}, {1, 1, 1}, 5), scenes::box({0, 0, 0}, {1, 1, 1}, 7), 36);
  expect_depths_when_moved(0, 0, scenes::box({0, 0, 0}, {1, 1, 1}), scenes::box({1, 1, 1}, {2, 2, 2}), 37);
}

/// Equal slabs but for a tower on one of them, in which the other's top goes on: all else is flush, however finely both
/// are cut. The tower's foot is 1 wide.
TEST(OverlapDepth, OfAFaceThatIsFlushBesideATower) {
  std::vector<double> cuts;
  for (int i = 0; i <= 12; ++i) cuts.push_back(i / 2.0);
  for (const int foot : {1, 3}) {
    const auto is_filled = [&](int i, int j, int k) { return k < 2 || (i / 2 == foot && j / 2 == 2); };
    const MeshData tower = scenes::boundary({cuts, cuts, {0, 1, 2, 4, 6}, is_filled}, 5);
    for (const int n : {1, 5}) expect_depths_when_moved(0.5, 0, scenes::box({0, 0, 0}, {6, 6, 2}, n), tower, 52);
  }
}

/// What lies beside the overlap, in one plane with what is a little deep, is outside.
TEST(OverlapDepth, OfShallowOverlapsIsKnownToTheSamePrecision) {
  for (const double depth : {1e-8, 1e-4, 0.01}) {
    const MeshData plate = scenes::box({-3, -3, -1}, {3, 3, depth});
    for (const int sides : {16, 50})
      expect_depths_when_moved(depth, depth, plate, scenes::pipe(sides, 1, 1, 2, true), 41);
    expect_depths_when_moved(depth, depth, scenes::box({0, 0, 0}, {1, 1, 1 + depth}, 4),
                             scenes::box({0.3, 0.4, 1}, {1.3, 1.4, 2}, 5), 42);
    expect_depths_when_moved(depth, depth, scenes::box({0, 0, 0}, {1, 1, 1 + depth}, 2),
                             scenes::box({0, 0, 1}, {1, 1, 2}, 3), 43);
  }
}

TEST(OverlapDepth, OfConvexSolidsIsWhatTheirPlanesSay) {
  int deep = 0;
  for (std::uint64_t seed = 1; seed <= 14; ++seed) {
    test::Seeded seeded(seed);
    const Mesh a =
        seed % 2 == 0 ? test::mesh_of(scenes::prism(regular(7, 1), -0.5, 0.5)) : box({0, 0, 0}, {1, 1, 1}, 2);
    const Mesh b =
        seed % 3 == 0 ? test::mesh_of(scenes::prism(regular(6, 0.5), -2, 2)) : box({-1, -1, -0.1}, {1, 1, 0});
    const Pose pose_a = scenes::random_motion(seeded.random, 0.4), pose_b = scenes::random_motion(seeded.random, 0.4);
    const auto depth = overlap_depth(a, pose_a, b, pose_b, 0.01);
    ASSERT_TRUE(depth) << depth.error().message;
    const double a_in_b = depth_in_convex(a, pose_a, b, pose_b), b_in_a = depth_in_convex(b, pose_b, a, pose_a);
    expect_holds(depth->a_in_b, a_in_b), expect_holds(depth->b_in_a, b_in_a);
    deep += int{a_in_b > 0.01} + int{b_in_a > 0.01};
  }
  EXPECT_GT(deep, 12);
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
