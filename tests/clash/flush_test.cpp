// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "impinge/clash.hpp"
#include "region_scenes.hpp"
#include "scenes/motion.hpp"
#include "scenes/solids.hpp"

/// Regions of contact within a tolerance: those of flush faces as they were meant to be, wherever the parts are put.
namespace impinge {
namespace {

using scenes::box;
using scenes::MeshData;
using scenes::pipe;
using scenes::regular;
using scenes::shifted;
using test::expect_near;

constexpr double kPi = std::numbers::pi;

/// What a region is to be, before it is moved.
struct Expected {
  double area, length;
  Point centroid, normal;
};

struct Flush {
  const char* name;
  MeshData a, b;
  std::vector<Expected> regions;  ///< in their order
};

double area_of(int sides, double radius) { return sides * radius * radius * std::sin(2 * kPi / sides) / 2; }
double length_of(int sides, double radius) { return 2 * sides * radius * std::sin(kPi / sides); }

/// A plate of 6 by 6, from z = -1 to 0, with a hole of 12 sides around the z axis.
MeshData drilled(double radius) {
  scenes::Outline outer;
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * kPi * i / 12, c = std::cos(angle), s = std::sin(angle),
                 size = 3 / std::max(std::abs(c), std::abs(s));
    outer.push_back({size * c, size * s});
  }
  return scenes::ring(outer, regular(12, radius), -1, 0);
}

std::vector<Flush> families() {
  std::vector<Flush> all;
  const Expected step{0.375, 2.5, {0.625, 0.75, 1}, {0, 0, 1}};
  for (const auto& [n, m] : {std::pair{1, 1}, {1, 4}, {3, 1}, {3, 7}})
    all.push_back({"box on box", box({0, 0, 0}, {1, 1, 1}, n), box({0.25, 0.5, 1}, {1.5, 2, 2}, m), {step}});
  for (const auto& [n, m] : {std::pair{1, 1}, {2, 4}, {2, 3}})
    all.push_back({"equal faces",
                   box({0, 0, 0}, {1, 1, 1}, n),
                   box({0, 0, 1}, {1, 1, 2}, m),
                   {{1, 4, {0.5, 0.5, 1}, {0, 0, 1}}}});
  all.push_back({"one corner in common",
                 box({0, 0, 0}, {1, 1, 1}),
                 box({0, 0, 1}, {0.5, 0.5, 2}, 5),
                 {{0.25, 2, {0.25, 0.25, 1}, {0, 0, 1}}}});
  all.push_back({"T-junctions",
                 scenes::block({0, 1, 2}, {0, 2}, {0, 1}),
                 scenes::block({0, 0.7, 2}, {0, 1.3, 2}, {1, 2}),
                 {{4, 8, {1, 1, 1}, {0, 0, 1}}}});
  all.push_back({"two feet",
                 box({-5, -5, -1}, {5, 5, 0}, 2),
                 scenes::joined(box({-3, -1, 0}, {-1, 1, 2}, 2), box({1, -0.5, 0}, {2, 0.5, 2}, 3)),
                 {{4, 8, {-2, 0, 0}, {0, 0, 1}}, {1, 4, {1.5, 0, 0}, {0, 0, 1}}}});
  for (const int sides : {8, 200})
    all.push_back({"caps",
                   scenes::prism(regular(sides, 1), -1, 0),
                   scenes::prism(regular(sides, 1), 0, 2),
                   {{area_of(sides, 1), length_of(sides, 1), {0, 0, 0}, {0, 0, 1}}}});
  all.push_back({"cap on plate",
                 box({-3, -3, -1}, {3, 3, 0}, 4),
                 pipe(48, 2, 1, 2, true),
                 {{area_of(48, 1), length_of(48, 1), {0, 0, 0}, {0, 0, 1}}}});
  // A ring around a hole that is wider than its own: the head of a bolt.
  all.push_back({"head on drilled plate",
                 drilled(1),
                 scenes::prism(regular(12, 1.5), 0, 0.5),
                 {{area_of(12, 1.5) - area_of(12, 1), length_of(12, 1.5) + length_of(12, 1), {0, 0, 0}, {0, 0, 1}}}});
  // Walls meet walls all around: nothing says which way out.
  all.push_back({"pin in hole",
                 drilled(1),
                 scenes::prism(regular(12, 1), -2, 1),
                 {{length_of(12, 1), 2 * length_of(12, 1), {0, 0, -0.5}, {0, 0, 0}}}});
  all.push_back({"line on plate",
                 box({-3, -3, -1}, {3, 3, 0}, 2),
                 scenes::hull({{-2, 0, 0}, {-2, 1, 1}, {-2, -1, 1}, {2, 0, 0}, {2, 1, 1}, {2, -1, 1}}),
                 {{0, 4, {0, 0, 0}, {0, 0, 1}}}});
  return all;
}

void expect_regions(const std::vector<Region>& found, const std::vector<Expected>& expected, const Pose& pose,
                    double off) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].area, expected[i].area, off * (1 + expected[i].length));
    EXPECT_NEAR(found[i].length, expected[i].length, 4 * off);
    expect_near(found[i].centroid, world_vertex(pose, expected[i].centroid), off);
    expect_near(found[i].normal, to_mat3(pose.R) * expected[i].normal, off);
  }
}

/// By poses and baked, near the origin and far from it.
TEST(Flush, RegionsAreThoseOfTheExactContactAfterAnyMotion) {
  test::Seeded seeded(51);
  for (const Flush& flush : families()) {
    SCOPED_TRACE(flush.name);
    const Mesh a = test::mesh_of(flush.a), b = test::mesh_of(flush.b);
    for (const double reach : {0.0, 5.0, 5.0, 1000.0}) {
      SCOPED_TRACE(reach);
      const Pose pose = reach == 0 ? Pose{} : scenes::random_motion(seeded.random, reach);
      const double tolerance = 0x1p-20 * (reach + 10);
      expect_regions(contact_regions(a, pose, b, pose, {.tolerance = tolerance}).value(), flush.regions, pose,
                     tolerance);
      std::vector<Region> exchanged = contact_regions(b, pose, a, pose, {.tolerance = tolerance}).value();
      for (Region& r : exchanged) r.normal = -1.0 * r.normal;
      expect_regions(exchanged, flush.regions, pose, tolerance);
      const Mesh baked_a = test::mesh_of(scenes::baked(flush.a, pose)),
                 baked_b = test::mesh_of(scenes::baked(flush.b, pose));
      const Clash clash = judge(baked_a, {}, baked_b, {}, {.regions = true}).value();
      EXPECT_EQ(name(clash.verdict), name(Verdict::touching));
      expect_regions(clash.regions, flush.regions, pose, tolerance);
    }
  }
}

/// Apart by less than the tolerance, or overlapping by less: the area is half-way.
TEST(Flush, GapsAndOverlapsWithinTheToleranceHaveTheRegionsOfFlushFaces) {
  test::Seeded seeded(52);
  const double tolerance = 0x1p-7;
  for (const double off : {0.9, 0.25, -0.25, -0.9})
    for (int turn = 0; turn < 3; ++turn) {
      SCOPED_TRACE(off);
      const Pose pose = turn == 0 ? Pose{} : scenes::random_motion(seeded.random, 5);
      for (const auto& [n, m] : {std::pair{1, 1}, {3, 4}}) {
        const Mesh a = test::mesh_of(box({0, 0, 0}, {1, 1, 1}, n)),
                   b = test::mesh_of(shifted(box({0.25, 0.5, 1}, {1.5, 2, 2}, m), 0, 0, off * tolerance));
        const std::vector<Expected> expected{{0.375, 2.5, {0.625, 0.75, 1 + off * tolerance / 2}, {0, 0, 1}}};
        const auto regions = contact_regions(a, pose, b, pose, {.tolerance = tolerance}).value();
        expect_regions(regions, expected, pose, tolerance);
        const Clash clash = judge(a, pose, b, pose, {.tolerance = tolerance, .regions = true}).value();
        EXPECT_EQ(name(clash.verdict), name(Verdict::touching));
        EXPECT_EQ(sentence(clash.note),
                  sentence(off > 0 ? Note::gap_within_tolerance : Note::overlap_within_tolerance));
        expect_regions(clash.regions, expected, pose, tolerance);
      }
      // With play all around.
      const double play = 0.25 * tolerance;
      const Mesh plate = test::mesh_of(drilled(1 + play)), pin = test::mesh_of(scenes::prism(regular(12, 1), -2, 1));
      const auto found = contact_regions(plate, pose, pin, pose, {.tolerance = tolerance}).value();
      expect_regions(found, {{length_of(12, 1), 2 * length_of(12, 1), {0, 0, -0.5}, {0, 0, 0}}}, pose, 2 * tolerance);
    }
}

/// What crosses is no area, at whatever angle, and its lines are the exact ones.
TEST(Flush, CrossingFacesShareNoArea) {
  test::Seeded seeded(53);
  const double tolerance = 0x1p-16;
  const MeshData plate{{-2, -2, 0, 2, -2, 0, 2, 2, 0, -2, 2, 0}, {0, 1, 2, 0, 2, 3}};
  for (const double rise : {1000.0, 1.0, 0.25, 0.0625, 0.015625}) {  // across 2, up so much
    const MeshData wall{{-1, -1, -rise, 1, -1, rise, 1, 1, rise, -1, 1, -rise}, {0, 1, 2, 0, 2, 3}};
    for (int turn = 0; turn < 3; ++turn) {
      SCOPED_TRACE(rise);
      const Pose pose = turn == 0 ? Pose{} : scenes::random_motion(seeded.random, 5);
      const auto regions =
          contact_regions(test::mesh_of(plate), pose, test::mesh_of(wall), pose, {.tolerance = tolerance}).value();
      ASSERT_EQ(regions.size(), 1u);
      EXPECT_EQ(regions[0].area, 0);
      EXPECT_NEAR(regions[0].length, 2, 16 * tolerance);
      expect_near(regions[0].centroid, world_vertex(pose, {0, 0, 0}), 16 * tolerance);
    }
  }
}

/// A bolt through a plate is one region of two loops, and its head makes the area of another.
TEST(Flush, LinesThatCrossAreAsTheyAreExactly) {
  test::Seeded seeded(54);
  const MeshData plate = box({-3, -3, 0}, {3, 3, 1}, 3), bolt = shifted(pipe(48, 40, 0.5, 5, true), 0.1, 0.2, -2);
  for (int turn = 0; turn < 4; ++turn) {
    const Pose pose = scenes::random_motion(seeded.random, 5);
    const auto regions =
        contact_regions(test::mesh_of(plate), pose, test::mesh_of(bolt), pose, {.tolerance = 0x1p-17}).value();
    ASSERT_EQ(regions.size(), 1u);
    EXPECT_EQ(regions[0].lines.size(), 2u);
    EXPECT_NEAR(regions[0].length, 2 * length_of(48, 0.5), 0x1p-12);
    EXPECT_NEAR(regions[0].area, 2 * area_of(48, 0.5), 0x1p-12);
    expect_near(regions[0].centroid, world_vertex(pose, {0.1, 0.2, 0.5}), 0x1p-12);
  }
}

/// Tolerances far below the size of triangles (1.25 to 3.3), near it, and above it. Walls beside each other, as far
/// apart as the triangles are large, end where the boxes meet, and share nothing.
TEST(Flush, ToleranceNearAndAboveTheSizeOfTriangles) {
  test::Seeded seeded(55);
  for (const auto& [n, m] : {std::pair{3, 4}, {1, 7}, {24, 1}, {20, 9}}) {
    const MeshData below = box({0, 0, 0}, {10, 10, 10}, n), above = box({1, 1, 10}, {6, 6, 15}, m);
    for (const double tolerance : {0.01, 0.3, 0.9, 1.0, 1.2, 1.5, 2.0}) {
      SCOPED_TRACE(std::to_string(n) + " and " + std::to_string(m) + " cells, tolerance " + std::to_string(tolerance));
      const Pose pose = scenes::random_motion(seeded.random, 12);
      const Mesh a = test::mesh_of(scenes::baked(below, pose)), b = test::mesh_of(scenes::baked(above, pose));
      expect_regions(contact_regions(a, {}, b, {}, {.tolerance = tolerance}).value(),
                     {{25, 20, {3.5, 3.5, 10}, {0, 0, 1}}}, pose, 1e-9);
    }
  }
}

/// Across a gap as wide as the triangles are: the plug's face lies over the floor, and its walls beside those of the
/// cavity.
TEST(Flush, GapsAsWideAsTheTriangles) {
  test::Seeded seeded(56);
  const MeshData socket =
      scenes::joined(box({-1, -1, -1}, {4, 4, 4}, 8), scenes::inverted(box({0, 0, 0}, {3, 3, 3}, 11)));
  for (const double gap : {0.05, 0.25, 0.4})
    for (const int cells : {1, 10}) {
      SCOPED_TRACE(std::to_string(gap) + ", cells " + std::to_string(cells));
      const MeshData plug = box({gap, gap, gap}, {3 - gap, 3 - gap, 3 - gap}, cells);
      const Pose pose = scenes::random_motion(seeded.random, 12);
      const auto regions = contact_regions(test::mesh_of(scenes::baked(socket, pose)), {},
                                           test::mesh_of(scenes::baked(plug, pose)), {}, {.tolerance = 1.1 * gap})
                               .value();
      ASSERT_EQ(regions.size(), 1u);
      const double side = 3 - 2 * gap;
      // Corners move by 5/4 of a quarter of the radius of the circle in the socket's triangles, at most.
      const double moved = 1.25 / 4 * (3.0 / 11) * (1 - std::sqrt(0.5));
      EXPECT_NEAR(regions[0].area, 6 * side * side, moved * 24 * side);
      expect_near(regions[0].centroid, world_vertex(pose, {1.5, 1.5, 1.5}), gap);
      EXPECT_EQ(regions[0].normal, (Point{0, 0, 0}));
    }
}

/// A round pin in a round hole with play, by tolerances up to the size of triangles: half-way between.
TEST(Flush, PlayAroundARoundPin) {
  test::Seeded seeded(57);
  const MeshData hole = scenes::ring(regular(64, 20), regular(64, 10.1), 0, 20), pin = pipe(64, 20, 10, 20, true);
  const Pose pose = scenes::random_motion(seeded.random, 50);
  const Mesh a = test::mesh_of(scenes::baked(hole, pose)), b = test::mesh_of(scenes::baked(pin, pose));
  for (const double tolerance : {0.2, 0.5, 1.0}) {
    SCOPED_TRACE(tolerance);
    const auto regions = contact_regions(a, {}, b, {}, {.tolerance = tolerance}).value();
    ASSERT_EQ(regions.size(), 1u);
    EXPECT_NEAR(regions[0].area, 20 * length_of(64, 10.05), 1);
    EXPECT_NEAR(regions[0].length, 2 * length_of(64, 10.05), 0.1);
    expect_near(regions[0].centroid, world_vertex(pose, {0, 0, 10}), 0.01);
    EXPECT_EQ(regions[0].normal, (Point{0, 0, 0}));
  }
}

TEST(Flush, RefusesAToleranceThatMeansNothing) {
  const Mesh cube = test::mesh_of(scenes::cube());
  for (const double tolerance : {-1.0, 1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto result = contact_regions(cube, {}, cube, {.t = {1, 0, 0}}, {.tolerance = tolerance});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, Code::bad_option);
  }
  // More than a million pairs.
  const MeshData sheet = scenes::flat_grid(40, 40);
  const Mesh fine = test::mesh_of(sheet), other = test::mesh_of(shifted(sheet, 0.3, 0.2, 0));
  const auto many = contact_regions(fine, {}, other, {}, {.tolerance = 13});
  ASSERT_FALSE(many);
  EXPECT_EQ(many.error().code, Code::bad_option);
  // Below what rounding leaves: exactly.
  EXPECT_TRUE(contact_regions(cube, {}, cube, {.t = {1 + 0x1p-50, 0, 0}}, {.tolerance = 0x1p-45}).value().empty());
  EXPECT_EQ(contact_regions(cube, {}, cube, {.t = {1 + 0x1p-50, 0, 0}}, {.tolerance = 0x1p-30}).value().size(), 1u);
  EXPECT_TRUE(contact_regions(cube, {}, test::mesh_of({}), {}, {.tolerance = 0.1}).value().empty());
}

}  // namespace
}  // namespace impinge
