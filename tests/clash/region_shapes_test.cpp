// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <numbers>

#include "region_scenes.hpp"
#include "scenes/motion.hpp"
#include "scenes/solids.hpp"
#include "tests/solid/placed.hpp"

/// Regions of contact whose measures are known.
namespace impinge {
namespace {

using scenes::box;
using scenes::pipe;
using scenes::shifted;
using test::expect_near;
using test::is_closed;
using test::region_between;
using test::regions_between;

constexpr double kPi = std::numbers::pi;

TEST(RegionShapes, BoxesThatOverlapAtACorner) {
  for (const int n : {1, 2, 5}) {
    const Region region = region_between(box({0, 0, 0}, {2, 2, 2}, n), box({1, 1, 1}, {3, 3, 3}, n));
    EXPECT_NEAR(region.length, 6, 1e-12);
    EXPECT_NEAR(region.area, std::sqrt(3), 1e-12);
    expect_near(region.normal, std::sqrt(1.0 / 3) * Point{1, 1, 1});
    expect_near(region.centroid, {1.5, 1.5, 1.5});
    EXPECT_EQ(region.box, (std::array<Point, 2>{Point{1, 1, 1}, {2, 2, 2}}));
    ASSERT_EQ(region.lines.size(), 1u);
    EXPECT_TRUE(is_closed(region.lines[0]));
  }
}

TEST(RegionShapes, BoxesThatOverlapAlongAnEdge) {
  const Region region = region_between(box({0, 0, 0}, {2, 2, 2}, 3), box({1, 1, 0.5}, {3, 3, 1.5}, 2));
  EXPECT_NEAR(region.length, 6, 1e-12);
  EXPECT_NEAR(region.area, std::sqrt(2), 1e-12);
  expect_near(region.normal, std::sqrt(0.5) * Point{1, 1, 0});
  ASSERT_EQ(region.lines.size(), 1u);
  EXPECT_TRUE(is_closed(region.lines[0]));
}

TEST(RegionShapes, ABoxThroughAPlateIsOneRegionOfTwoLoops) {
  for (const int n : {1, 4, 7})
    for (const int m : {1, 3}) {
      const Region region = region_between(box({-5, -5, 0}, {5, 5, 1}, m), box({-1, -1, -2}, {1, 1, 3}, n));
      EXPECT_NEAR(region.length, 16, 1e-11);
      EXPECT_NEAR(region.area, 8, 1e-11);
      expect_near(region.normal, {0, 0, 0});
      expect_near(region.centroid, {0, 0, 0.5});
      ASSERT_EQ(region.lines.size(), 2u);
      for (const auto& line : region.lines) EXPECT_TRUE(is_closed(line));
    }
}

TEST(RegionShapes, AFinelyDividedBoltThroughAPlateIsOneRegion) {
  const double r = 0.5;
  const scenes::MeshData plate = box({-3, -3, 0}, {3, 3, 1}, 3);
  const scenes::MeshData bolt = shifted(pipe(48, 40, r, 5, true), 0.1, 0.2, -2);
  const Region region = region_between(plate, bolt);
  EXPECT_NEAR(region.length, 2 * 48 * 2 * r * std::sin(kPi / 48), 1e-11);
  EXPECT_NEAR(region.area, 48 * r * r * std::sin(2 * kPi / 48), 1e-11);
  expect_near(region.normal, {0, 0, 0});
  expect_near(region.centroid, {0.1, 0.2, 0.5}, 1e-11);
  EXPECT_EQ(region.lines.size(), 2u);
  // Nothing joins the two loops where the bolt is a sheet that encloses nothing, for the plate's surface inside it is
  // none: the plate still does.
  EXPECT_EQ(regions_between(plate, shifted(pipe(48, 40, r, 5, false), 0.1, 0.2, -2)).size(), 1u);
  // A sheet through a sheet.
  EXPECT_EQ(regions_between(scenes::joined(scenes::flat_grid(6, 6), shifted(scenes::flat_grid(6, 6), 0, 0, 1)),
                            shifted(pipe(48, 40, r, 5, false), 3.1, 3.2, -2))
                .size(),
            2u);
}

TEST(RegionShapes, TwoBoltsThroughOnePlateAreTwoRegions) {
  const scenes::MeshData bolt = shifted(pipe(32, 20, 0.5, 5, true), 0, 0, -2);
  const auto regions = regions_between(box({-3, -3, 0}, {3, 3, 1}, 2), scenes::joined(bolt, shifted(bolt, 2, 0.5, 0)));
  ASSERT_EQ(regions.size(), 2u);
  for (const Region& region : regions) EXPECT_EQ(region.lines.size(), 2u);
  EXPECT_NEAR(regions[0].area, regions[1].area, 1e-12);
}

/// A tube with a wall: nothing of the ring that it cuts out of a large triangle is on an edge.
TEST(RegionShapes, AThickPipeThroughALargeTriangleIsOneRegion) {
  scenes::MeshData tube = pipe(24, 6, 0.5, 5, false);
  tube = scenes::joined(tube, scenes::inverted(pipe(24, 6, 0.3, 5, false)));
  const auto rings = [&](std::uint32_t first, bool up) {  // closes both ends between the outer and the inner ring
    const auto outer = first, inner = static_cast<std::uint32_t>(tube.vertex_count() / 2) + first;
    for (std::uint32_t i = 0; i < 24; ++i) {
      const std::uint32_t j = (i + 1) % 24;
      tube.add_triangle(outer + i, up ? outer + j : inner + j, up ? inner + j : outer + j);
      tube.add_triangle(outer + i, up ? inner + j : inner + i, up ? inner + i : inner + j);
    }
  };
  rings(0, false), rings(6 * 24, true);
  const scenes::MeshData plate = box({-10, -10, 0}, {10, 10, 1});
  const scenes::MeshData through = shifted(tube, 4, 1, -2);
  const Region region = region_between(plate, through);
  EXPECT_EQ(region.lines.size(), 4u);
  EXPECT_EQ(region_between(through, plate).lines.size(), 4u);
  EXPECT_EQ(regions_between(plate, scenes::joined(through, shifted(through, -8, 0.5, 0))).size(), 2u);
  // One inside the other's bore, with play between them.
  const scenes::MeshData bar = shifted(pipe(12, 6, 0.2, 5, true), 4, 1, -2);
  EXPECT_EQ(regions_between(plate, scenes::joined(through, bar)).size(), 2u);
}

/// A blind hole's pin, whose end is deep in the block: one loop, and the way out is along the pin.
TEST(RegionShapes, APinInABlockIsPushedOutAlongItself) {
  const Region region =
      region_between(box({-3, -3, -3}, {3, 3, 0}), shifted(pipe(24, 9, 0.5, 3, true), 0.25, 0.125, -1));
  ASSERT_EQ(region.lines.size(), 1u);
  expect_near(region.normal, {0, 0, 1});
  EXPECT_NEAR(region.area, 12 * 0.25 * std::sin(2 * kPi / 24), 1e-12);
}

TEST(RegionShapes, FlushBoxesShareTheAreaOfTheOverlap) {
  for (const int n : {1, 2, 3, 7})
    for (const int m : {1, 3, 4}) {
      const Region region = region_between(box({0, 0, 0}, {1, 1, 1}, n), box({0.25, 0.5, 1}, {1.5, 2, 2}, m));
      EXPECT_NEAR(region.area, 0.375, 1e-14);
      EXPECT_NEAR(region.length, 2.5, 1e-13);
      expect_near(region.centroid, {0.625, 0.75, 1}, 1e-14);
      EXPECT_EQ(region.normal, (Point{0, 0, 1}));
      ASSERT_EQ(region.lines.size(), 1u) << n << ' ' << m;
      EXPECT_TRUE(is_closed(region.lines[0]));
    }
}

TEST(RegionShapes, CubesThatAreTheSameShareTheirSurface) {
  const Region region = region_between(scenes::cube(), scenes::cube());
  EXPECT_NEAR(region.area, 6, 1e-14);
  EXPECT_EQ(region.normal, (Point{0, 0, 0}));  // no way leads out: the normals are the same
  EXPECT_TRUE(region.lines.empty());
  expect_near(region.centroid, {0.5, 0.5, 0.5}, 1e-15);
}

/// Flush on the inside: the shared face gives no direction, the crossing ones do not close.
TEST(RegionShapes, AlignedOverlapHasTheAreaOfItsSharedFaces) {
  const Region region = region_between(box({0, 0, 0}, {2, 2, 2}, 2), box({1, 0.5, 0}, {3, 1.5, 1}, 2));
  EXPECT_NEAR(region.area, 1, 1e-14);
  EXPECT_EQ(region.normal, (Point{0, 0, 0}));
}

TEST(RegionShapes, SpheresMeetInALens) {
  const scenes::MeshData sphere = scenes::uv_sphere(96, 72);
  for (const Vec3& way : {Vec3{1, 0, 0}, Vec3{0, 0.6, 0.8}, Vec3{-0.48, 0.64, 0.6}}) {
    const Region region = region_between(sphere, sphere, {}, {.t = {1.6 * way.x, 1.6 * way.y, 1.6 * way.z}});
    ASSERT_EQ(region.lines.size(), 1u);
    EXPECT_TRUE(is_closed(region.lines[0]));
    EXPECT_NEAR(region.length, 2 * kPi * 0.6, 0.02);
    EXPECT_NEAR(region.area, kPi * 0.36, 0.01);
    expect_near(region.normal, way, 0.003);
    expect_near(region.centroid, 0.8 * way, 0.003);
  }
}

TEST(RegionShapes, AVertexOnAFaceIsAPoint) {
  const Point tip{0.3, 0.2, 1};
  const Region region =
      region_between(box({-1, -1, 0}, {1, 1, 1}), test::tetrahedron({Point{1, 0, 3}, {0, 2, 3}, {-1, -1, 3}, tip}));
  EXPECT_EQ(region.pairs, 3u);
  EXPECT_EQ(region.area, 0);
  EXPECT_EQ(region.length, 0);
  EXPECT_TRUE(region.lines.empty());
  EXPECT_EQ(region.centroid, tip);
  EXPECT_EQ(region.normal, (Point{0, 0, 1}));
  EXPECT_EQ(region.box, (std::array{tip, tip}));
  EXPECT_EQ(region.triangles_a.size(), 1u);
  EXPECT_EQ(region.triangles_b.size(), 3u);
}

TEST(RegionShapes, EdgesMeetInAPointOrALine) {
  // A roof below, its ridge along x; one above, turned over, its ridge along y.
  const scenes::MeshData roof =
      scenes::hull({{-2, 1, -1}, {-2, 0, 0}, {-2, -1, -1}, {3, 1, -1}, {3, 0, 0}, {3, -1, -1}});
  const scenes::MeshData crossed =
      scenes::hull({{1, -2, 1}, {0, -2, 0}, {-1, -2, 1}, {1, 3, 1}, {0, 3, 0}, {-1, 3, 1}});
  const Region point = region_between(roof, crossed);
  EXPECT_EQ(point.centroid, (Point{0, 0, 0}));
  EXPECT_EQ(point.length, 0);
  EXPECT_GE(point.pairs, 4u);
  expect_near(point.normal, {0, 0, 1});
  // On a face.
  const Region line = region_between(roof, box({-1, -3, 0}, {1, 3, 2}));
  EXPECT_NEAR(line.length, 2, 1e-15);
  EXPECT_EQ(line.area, 0);
  EXPECT_EQ(line.normal, (Point{0, 0, 1}));
  ASSERT_EQ(line.lines.size(), 1u);
  EXPECT_EQ(line.lines[0].front(), (Point{-1, 0, 0}));
  EXPECT_EQ(line.lines[0].back(), (Point{1, 0, 0}));
}

/// Two faces that have an edge in common in part only: the one is divided where the other is not.
TEST(RegionShapes, LinesAndOutlinesOfTJunctionsCountOnce) {
  // Ridges along each other, from -2 to 3 and from 0 to 4; one side of the lower roof is divided at 0.75.
  scenes::MeshData roof = scenes::hull({{-2, 1, -1}, {-2, 0, 0}, {-2, -1, -1}, {3, 1, -1}, {3, 0, 0}, {3, -1, -1}});
  const scenes::MeshData divided{{-2, 0, 0, 0.75, 0, 0, 3, 0, 0, 0, 1, -1, -2, -1, -1, 3, -1, -1},
                                 {0, 1, 3, 1, 2, 3, 0, 4, 5, 0, 5, 2}};
  const scenes::MeshData above = scenes::hull({{0, -1, 1}, {0, 0, 0}, {0, 1, 1}, {4, -1, 1}, {4, 0, 0}, {4, 1, 1}});
  for (const scenes::MeshData& below : {roof, divided}) {
    const Region line = region_between(below, above);
    EXPECT_NEAR(line.length, 3, 1e-15);
    EXPECT_EQ(line.lines.size(), 1u);
    expect_near(line.centroid, {1.5, 0, 0}, 1e-15);
  }
  // A knife's edge from (0, 0) to (3, 7) on a grid, whose lines it meets in points that are rounded.
  const scenes::MeshData knife{{0, 0, 0, 0.75, 1.75, 0, 3, 7, 0, 5, 0, 2, -5, 5, 2}, {0, 1, 3, 1, 2, 3, 0, 2, 4}};
  const Region cut = region_between(shifted(scenes::flat_grid(11, 11), -2, -2, 0), knife);
  EXPECT_NEAR(cut.length, std::sqrt(58), 1e-14);
  EXPECT_EQ(cut.lines.size(), 1u);
  // A face of two parts, one of which is divided.
  const scenes::MeshData sheet{{0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 2, 2, 0},
                               {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 6, 6, 5, 7, 6, 7, 2}};
  const Region flush = region_between(sheet, box({0, 0, 0}, {2, 2, 1}));
  EXPECT_NEAR(flush.area, 4, 1e-14);
  EXPECT_NEAR(flush.length, 8, 1e-14);
  EXPECT_EQ(flush.lines.size(), 1u);
}

/// Each shell has its own sense: a plug in a closed cavity, whose normals look inwards, leaves it upwards if it lies on
/// its floor.
TEST(RegionShapes, ACavityHasItsOwnSense) {
  const scenes::MeshData outer = box({0, 0, 0}, {9, 9, 9}), hollow = scenes::inverted(box({3, 3, 3}, {6, 6, 6}));
  const scenes::MeshData plug = box({4, 4, 3}, {5, 5, 4});
  // Both ways of writing the cavity mean another thing, but the outer shell means the same.
  EXPECT_EQ(region_between(scenes::joined(outer, hollow), plug).normal, (Point{0, 0, 1}));
  EXPECT_EQ(region_between(scenes::inverted(scenes::joined(outer, hollow)), plug).normal, (Point{0, 0, 1}));
  EXPECT_EQ(region_between(plug, scenes::joined(outer, hollow)).normal, (Point{0, 0, -1}));
  // Two blocks, one of them written inside out.
  const scenes::MeshData blocks = scenes::joined(outer, scenes::inverted(box({20, 0, 0}, {21, 1, 1})));
  EXPECT_EQ(region_between(blocks, box({20, 0, 1}, {21, 1, 2})).normal, (Point{0, 0, 1}));
  EXPECT_EQ(region_between(blocks, box({3, 3, 9}, {4, 4, 10})).normal, (Point{0, 0, 1}));
}

TEST(RegionShapes, InvertedMeshesMeanTheSame) {
  const scenes::MeshData sphere = scenes::uv_sphere(24, 18), block = box({-1, -1, -3}, {1, 1, -0.75}, 3);
  const Region expected = region_between(sphere, block);
  expect_near(expected.normal, {0, 0, -1}, 1e-9);
  for (const auto& [a, b] : {std::pair{scenes::inverted(sphere), block},
                             {sphere, scenes::inverted(block)},
                             {scenes::inverted(sphere), scenes::inverted(block)}})
    EXPECT_EQ(region_between(a, b).normal, expected.normal);
  const scenes::MeshData lid = box({-1, -1, 1}, {1, 1, 2}), base = box({-1, -1, 0}, {1, 1, 1});
  EXPECT_EQ(region_between(scenes::inverted(base), lid).normal, (Point{0, 0, 1}));
}

/// Everything is carried along by a motion, up to rounding.
TEST(RegionShapes, MoveWithThePose) {
  test::Seeded seeded(21);
  const scenes::MeshData sphere = scenes::uv_sphere(40, 30), bolt = shifted(pipe(32, 20, 0.4, 5, true), 0, 0, -2);
  const scenes::MeshData plate = box({-3, -3, 0}, {3, 3, 0.7}, 2);
  for (int i = 0; i < 12; ++i) {
    const double reach = std::array{0.0, 10.0, 1e6}[static_cast<std::size_t>(i % 3)], off = reach == 1e6 ? 1e-8 : 1e-12;
    const Pose pose = scenes::random_motion(seeded.random, reach);
    const scenes::MeshData other = shifted(sphere, 1.1, 0.3, 0.2);
    const Region still = region_between(sphere, other), moved = region_between(sphere, other, pose, pose);
    EXPECT_NEAR(moved.area, still.area, off);
    EXPECT_NEAR(moved.length, still.length, off);
    expect_near(moved.normal, to_mat3(pose.R) * still.normal, off);
    expect_near(moved.centroid, world_vertex(pose, still.centroid), off);
    EXPECT_EQ(moved.lines.size(), 1u);
    EXPECT_EQ(region_between(plate, bolt, pose, pose).lines.size(), 2u);
  }
}

}  // namespace
}  // namespace impinge
