// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The oracle against itself: its fast way against rationals alone, and both against answers found by hand.
#include <gtest/gtest.h>

#include <algorithm>

#include "expected.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"

namespace impinge {
namespace {

using expected::Set;
using scenes::MeshData;
using scenes::PlacedScene;
using scenes::Random;

constexpr std::uint32_t kCross = 0, kTouch = 1, kFlat = 2;

PlacedScene triangle_pair(const std::array<double, 9>& a, const std::array<double, 9>& b) {
  MeshData mesh_a, mesh_b;
  mesh_a.add_triangle(a);
  mesh_b.add_triangle(b);
  return scenes::pair_scene(mesh_a, mesh_b);
}

void expect_agreement(const PlacedScene& scene) {
  expected::expect_same(expected::by_rationals(scene), expected::computed_set(scene));
}

struct Known {
  const char* name;
  std::array<double, 9> b;
  Set set;
};

TEST(Oracle, AnswersPairsKnownByHand) {
  const std::array<double, 9> a{0, 0, 0, 4, 0, 0, 0, 4, 0};
  const std::vector<Known> known{
      {"pierced in the middle", {1, 1, -1, 1, 1, 1, 1, 2, 1}, {{0, 1, 0, 0, kCross}}},
      {"cut from corner to side", {-1, -1, 1, -1, -1, -1, 5, 5, 0}, {{0, 1, 0, 0, kCross}}},
      {"stands on it with a side", {1, 1, 0, 2, 1, 0, 1, 1, 3}, {{0, 1, 0, 0, kTouch}}},
      {"stands on it with a corner", {1, 1, 0, 2, 1, 3, 1, 1, 3}, {{0, 1, 0, 0, kTouch}}},
      {"goes through its side", {1, -1, 0, 1, 1, 0, 1, 0, 2}, {{0, 1, 0, 0, kTouch}}},
      {"crosses the side alone", {-1, 0, -1, 5, 0, -1, 2, 0, 1}, {{0, 1, 0, 0, kTouch}}},
      {"shares a side, plane differs", {0, 0, 0, 4, 0, 0, 0, 0, 4}, {{0, 1, 0, 0, kTouch}}},
      {"shares a side in the plane", {0, 0, 0, 4, 0, 0, 0, -4, 0}, {{0, 1, 0, 0, kFlat}}},
      {"shares a corner in the plane", {0, 0, 0, -4, 0, 0, 0, -4, 0}, {{0, 1, 0, 0, kFlat}}},
      {"lies inside it", {1, 1, 0, 1.5, 1, 0, 1, 1.5, 0}, {{0, 1, 0, 0, kFlat}}},
      {"a segment through it", {1, 1, -1, 1, 1, 1, 1, 1, 0}, {{0, 1, 0, 0, kTouch}}},
      {"a segment in it", {1, 1, 0, 2, 1, 0, 1.5, 1, 0}, {{0, 1, 0, 0, kTouch}}},
      {"a point in it", {1, 1, 0, 1, 1, 0, 1, 1, 0}, {{0, 1, 0, 0, kTouch}}},
      {"a point beside it, in the plane", {3, 3, 0, 3, 3, 0, 3, 3, 0}, {}},
      {"the next number above it", {1, 1, 5e-324, 2, 1, 5e-324, 1, 2, 1}, {}},
      {"beside it in the plane", {5, 0, 0, 9, 0, 0, 5, 4, 0}, {}},
      {"parallel", {0, 0, 1, 4, 0, 1, 0, 4, 1}, {}},
  };
  for (const Known& pair : known) {
    SCOPED_TRACE(pair.name);
    const PlacedScene scene = triangle_pair(a, pair.b);
    expected::expect_same(pair.set, expected::computed_set(scene));
    expected::expect_same(pair.set, expected::by_rationals(scene));
    const PlacedScene swapped = triangle_pair(pair.b, a);
    expected::expect_same(pair.set, expected::computed_set(swapped));
    expected::expect_same(pair.set, expected::by_rationals(swapped));
  }
}

TEST(Oracle, ASurfaceMeetsItselfWhereTrianglesShareACorner) {
  // The triangles of a cube have nothing in common but common corners and sides; a face is two triangles in a row.
  const PlacedScene scene = scenes::cube_pair({0, 0, 0});
  const std::vector<std::uint32_t>& index = scene.meshes[0].triangles;
  Set set;
  for (std::uint32_t a = 0; a < 12; ++a)
    for (std::uint32_t b = 0; b < 12; ++b) {
      const auto of_a = index.begin() + 3 * a;
      if (std::find_first_of(of_a, of_a + 3, index.begin() + 3 * b, index.begin() + 3 * b + 3) != of_a + 3)
        set.push_back({0, 1, a, b, a / 2 == b / 2 ? kFlat : kTouch});
    }
  expected::expect_same(set, expected::computed_set(scene));
  expected::expect_same(set, expected::by_rationals(scene));
}

TEST(Oracle, GroupsAreNotCompared) {
  PlacedScene scene = scenes::flush_boxes(3, 1, 1);
  scene.objects[0].group = scene.objects[1].group = 7;
  for (const auto& contact : expected::computed_set(scene)) {
    EXPECT_EQ(contact[0], 1u);
    EXPECT_EQ(contact[1], 2u);
  }
  expect_agreement(scene);
}

TEST(Oracle, AgreesWithRationalsOnIntegerSoups) {
  for (const int side : {1, 2, 3, 5})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", side " + std::to_string(side));
      Random random(seed);
      const PlacedScene scene =
          scenes::pair_scene(scenes::integer_soup(random, 60, side), scenes::integer_soup(random, 60, side));
      EXPECT_FALSE(expected::computed_set(scene).empty());
      expect_agreement(scene);
      expect_agreement(scenes::moved(scene, scenes::random_motion(random, 10)));
    }
}

TEST(Oracle, AgreesWithRationalsOnDegenerateAndThinTriangles) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    expect_agreement(
        scenes::pair_scene(scenes::degenerate_soup(random, 60, 2), scenes::degenerate_soup(random, 60, 2)));
    expect_agreement(scenes::pair_scene(scenes::degenerate_soup(random, 60, 2), scenes::integer_soup(random, 60, 2)));
    const MeshData slivers = scenes::sliver_soup(random, 60);
    expect_agreement(scenes::pair_scene(slivers, slivers));
  }
}

TEST(Oracle, AgreesWithRationalsOnFlushShapes) {
  Random random(1);
  const auto motion = scenes::random_motion(random, 10);
  for (const PlacedScene& scene : {scenes::cube_pair({1, 0, 0}), scenes::t_junctions(2), scenes::flush_boxes(2, 2, 2),
                                   scenes::shifted_pair(scenes::bumpy_grid(4, 4), {0.5, 0, 0}),
                                   scenes::shifted_pair(scenes::flat_grid(4, 4), {1, 0, 0})}) {
    const PlacedScene moved = scenes::moved(scene, motion);
    expect_agreement(scene);
    expect_agreement(moved);
    // The oracle's program places objects by its own code; here it gets the numbers that the baked scene holds.
    expected::expect_same(expected::computed_set(moved), expected::computed_set(scenes::baked(moved)));
  }
}

TEST(Oracle, AgreesWithRationalsAtTheDomainsBorders) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Random random(seed);
    const MeshData a = scenes::integer_soup(random, 40, 3);
    const MeshData b = scenes::integer_soup(random, 40, 3);
    for (const double scale : {0x1p-358, 0x1p298}) {
      expect_agreement(
          scenes::pair_scene(scenes::scaled(a, scale, scale, scale), scenes::scaled(b, scale, scale, scale)));
      expect_agreement(scenes::pair_scene(scenes::scaled(a, scale, 1, 1), scenes::scaled(b, scale, 1, 1)));
    }
    expect_agreement(
        scenes::pair_scene(scenes::scaled(a, 0x1p298, 1, 0x1p-358), scenes::scaled(b, 0x1p298, 1, 0x1p-358)));
  }
}

}  // namespace
}  // namespace impinge
