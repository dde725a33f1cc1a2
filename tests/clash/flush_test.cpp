// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <numbers>

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

scenes::Outline regular(int sides, double radius) {
  scenes::Outline outline;
  for (int i = 0; i < sides; ++i)
    outline.push_back({radius * std::cos(2 * kPi * i / sides), radius * std::sin(2 * kPi * i / sides)});
  return outline;
}
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
                 test::both(box({-3, -1, 0}, {-1, 1, 2}, 2), box({1, -0.5, 0}, {2, 0.5, 2}, 3)),
                 {{4, 8, {-2, 0, 0}, {0, 0, 1}}, {1, 4, {1.5, 0, 0}, {0, 0, 1}}}});
  for (const int sides : {8, 64, 200})
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
                 test::prism({{-2, 0, 0}, {-2, 1, 1}, {-2, -1, 1}}, {4, 0, 0}),
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

double largest_of(const std::vector<Region>& regions) {
  double largest = 0;
  for (const Region& r : regions)
    largest = std::max({largest, max_component(abs(r.box[0])), max_component(abs(r.box[1]))});
  return largest;
}

/// By poses and baked, near the origin and far from it.
TEST(Flush, RegionsAreThoseOfTheExactContactAfterAnyMotion) {
  test::Seeded seeded(51);
  for (const Flush& flush : families()) {
    SCOPED_TRACE(flush.name);
    for (int turn = 0; turn < 7; ++turn) {
      SCOPED_TRACE(turn);
      const double reach = turn == 0 ? 0 : turn % 3 == 0 ? 1000 : 5;
      const Pose pose = turn == 0 ? Pose{} : scenes::random_motion(seeded.random, reach);
      const double tolerance = 0x1p-20 * (reach + 10);
      const Mesh a = test::mesh_of(flush.a), b = test::mesh_of(flush.b);
      const auto posed = contact_regions(a, pose, b, pose, {.tolerance = tolerance}).value();
      expect_regions(posed, flush.regions, pose, tolerance);
      const Mesh baked_a = test::mesh_of(scenes::baked(flush.a, pose)),
                 baked_b = test::mesh_of(scenes::baked(flush.b, pose));
      expect_regions(contact_regions(baked_a, {}, baked_b, {}, {.tolerance = tolerance}).value(), flush.regions, pose,
                     tolerance);
      expect_regions(contact_regions(b, pose, a, pose, {.tolerance = tolerance}).value().size() == posed.size()
                         ? posed
                         : std::vector<Region>{},
                     flush.regions, pose, tolerance);
      const Clash clash = judge(a, pose, b, pose, {.regions = true}).value();
      EXPECT_EQ(name(clash.verdict), name(Verdict::touching));
      expect_regions(clash.regions, flush.regions, pose, 0x1p-19 * (1 + largest_of(clash.regions)));
    }
  }
}

}  // namespace
}  // namespace impinge
