// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The volume that two solids share, against counted cells and against sums over a partition of space.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "impinge/clash.hpp"
#include "impinge/measures.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::MeshData;

void expect_volume(double truth, const MeshData& a, const Pose& pose_a, const MeshData& b, const Pose& pose_b,
                   double rounding = 1e-12) {
  const Mesh mesh_a = test::mesh_of(a), mesh_b = test::mesh_of(b);
  for (const bool is_swapped : {false, true}) {
    const auto found =
        is_swapped ? overlap_volume(mesh_b, pose_b, mesh_a, pose_a) : overlap_volume(mesh_a, pose_a, mesh_b, pose_b);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_LE(std::abs(found->volume - truth), found->error + rounding * truth) << "truth " << truth;
    EXPECT_LE(found->error, 1e-5 * (1 + truth)) << "truth " << truth;
  }
}

/// Flush faces, edges and vertices everywhere, and cells that meet along an edge alone.
TEST(OverlapVolume, OfCellsOfALatticeIsCounted) {
  test::Seeded seeded(7);
  const std::vector<double> x{0, 1, 1.5, 3, 4}, y{0, 2, 3, 3.25}, z{0, 1, 2, 4};
  int left_out = 0;
  for (int round = 0; round < 40; ++round) {
    std::array<std::array<bool, 36>, 2> filled{};
    for (auto& part : filled)
      for (bool& cell : part) cell = seeded.random.integer(0, 2) > 0;
    const auto part = [&](std::size_t which) {
      return scenes::boundary({x, y, z, [&, which](int i, int j, int k) { return filled[which][9 * i + 3 * j + k]; }},
                              1 + which);
    };
    double truth = 0;
    for (std::size_t i = 0; i < 36; ++i)
      if (filled[0][i] && filled[1][i])
        truth += (x[i / 9 + 1] - x[i / 9]) * (y[i / 3 % 3 + 1] - y[i / 3 % 3]) * (z[i % 3 + 1] - z[i % 3]);
    // A hole all of whose corners are on the surface around it is taken for a solid that touches it.
    if (examine(test::mesh_of(part(0)))->turned + examine(test::mesh_of(part(1)))->turned > 0) {
      ++left_out;
      continue;
    }
    const Pose pose = round % 3 == 0 ? Pose{} : scenes::random_motion(seeded.random, round % 3 == 1 ? 10 : 1e5);
    expect_volume(truth, part(0), pose, part(1), pose, 1e-9);
  }
  EXPECT_LE(left_out, 2);
}

TEST(OverlapVolume, OfASolidWithItselfIsItsVolume) {
  test::Seeded seeded(3);
  for (const MeshData& mesh : {scenes::cube(), scenes::uv_sphere(24, 12), inverted(scenes::torus_knot_of(2000))}) {
    double volume = 0;
    for (const auto& [p, q, r] : test::world_triangles(test::mesh_of(mesh), {})) volume += dot(p, cross(q, r)) / 6;
    volume = std::abs(volume);  // whichever way they look
    const Pose pose = scenes::random_motion(seeded.random, 9);
    expect_volume(volume, mesh, pose, mesh, pose, 1e-9);
    expect_volume(volume, mesh, {}, scenes::box({-9, -9, -9}, {9, 9, 9}, 3), {});
    expect_volume(0, mesh, {}, scenes::box({-9, -9, 5}, {9, 9, 9}), {});
  }
}

/// What boxes that fill space have in common with a solid is the whole of it.
TEST(OverlapVolume, OfAPartitionAddsUp) {
  test::Seeded seeded(11);
  const MeshData knot = scenes::torus_knot_of(1200);
  const double volume = overlap_volume(test::mesh_of(knot), {}, test::mesh_of(knot), {})->volume;
  for (int round = 0; round < 4; ++round) {
    const Pose pose = scenes::random_motion(seeded.random, 0.5), grid = scenes::random_motion(seeded.random, 0.5);
    double sum = 0;
    for (int i = 0; i < 27; ++i) {
      const std::array<double, 4> cuts{-20, -1, 0.75, 20};
      const int x = i / 9, y = i / 3 % 3, z = i % 3;
      const Mesh cell =
          test::mesh_of(scenes::box({cuts[x], cuts[y], cuts[z]}, {cuts[x + 1], cuts[y + 1], cuts[z + 1]}));
      const auto part = overlap_volume(test::mesh_of(knot), pose, cell, grid);
      ASSERT_TRUE(part) << part.error().message;
      sum += part->volume;
    }
    EXPECT_NEAR(sum, volume, 1e-6 * volume);
  }
}

TEST(OverlapVolume, CountsCavitiesAndTurnedPartsAsTheyAre) {
  const MeshData shell = joined(scenes::box({0, 0, 0}, {10, 10, 10}), inverted(scenes::box({2, 2, 2}, {8, 8, 8})));
  const MeshData plug = scenes::box({2, 2, 2}, {8, 8, 9});
  expect_volume(36, shell, {}, plug, {});
  expect_volume(36, inverted(shell), {}, plug, {});
  expect_volume(36, shell, {}, inverted(plug), {});
  expect_volume(0, shell, {}, scenes::box({2, 2, 2}, {8, 8, 8}), {});
  // At a face, an edge, a vertex, and apart.
  for (const double y : {0, 10})
    for (const double z : {0, 10})
      expect_volume(0, scenes::box({0, 0, 0}, {10, 10, 10}), {}, scenes::box({10, y, z}, {20, y + 10, z + 10}), {});
  expect_volume(0, plug, {}, scenes::box({11, 2, 2}, {12, 8, 9}), {});
  EXPECT_EQ(overlap_volume(test::mesh_of(scenes::opened(plug)), {}, test::mesh_of(plug), {}).error().code,
            Code::bad_mesh);
}

/// What a clash says of it, by formulae.
TEST(OverlapVolume, IsToldOfSolidsThatOverlapWhereItIsAskedFor) {
  const MeshData a = scenes::box({0, 0, 0}, {4, 2, 2});
  MeshData cracked = scenes::unshared(scenes::box({3, 1, 1}, {6, 3, 3}, 3));
  cracked.xyz[2] += 1e-4;
  struct Case {
    MeshData b;
    Verdict verdict;
    std::optional<double> volume;
    double tolerance = 1e-5;
  };
  const std::vector<Case> cases{
      {scenes::box({3, 1, 1}, {6, 3, 3}), Verdict::penetrating, 1},
      {scenes::box({1, 0.5, 0.5}, {2, 1, 1.5}), Verdict::inside, 0.5},
      {scenes::box({-1, -1, -1}, {9, 9, 9}), Verdict::inside, 16},
      {a, Verdict::duplicate, 16},
      {scenes::box({3.75, 0, 0}, {6, 2, 2}), Verdict::penetrating, 1},
      {scenes::box({3.75, 0, 0}, {6, 2, 2}), Verdict::touching, 1, 0.5},
      {scenes::box({4, 0, 0}, {6, 2, 2}), Verdict::touching, std::nullopt},
      {scenes::box({4, 0, 0}, {6, 2, 2}), Verdict::touching, std::nullopt, 0.5},
      {scenes::box({5, 0, 0}, {6, 2, 2}), Verdict::apart, std::nullopt},
      {cracked, Verdict::penetrating, std::nullopt},
      {scenes::sheet({3, 6}, {1, 3}, 1), Verdict::crossing, std::nullopt},
  };
  test::Seeded seeded(5);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& [b, verdict, volume, tolerance] = cases[i];
    for (const double far : {0.0, 10.0, 1e4}) {
      SCOPED_TRACE(testing::Message() << "case " << i << ", " << far << " away");
      const Pose pose = far == 0 ? Pose{} : scenes::random_motion(seeded.random, far);
      ClashOptions options{.tolerance = tolerance, .volumes = true};
      const auto found = judge(test::mesh_of(a), pose, test::mesh_of(b), pose, options);
      ASSERT_TRUE(found) << found.error().message;
      EXPECT_EQ(found->verdict, verdict);
      ASSERT_EQ(found->overlap_volume.has_value(), volume.has_value());
      if (volume) {
        EXPECT_LE(std::abs(found->overlap_volume->volume - *volume), found->overlap_volume->error + 1e-12 * (1 + far));
        EXPECT_LE(found->overlap_volume->error, 1e-6);
      }
      options.volumes = false;
      EXPECT_FALSE(judge(test::mesh_of(a), pose, test::mesh_of(b), pose, options)->overlap_volume);
    }
  }
}

}  // namespace
}  // namespace impinge
