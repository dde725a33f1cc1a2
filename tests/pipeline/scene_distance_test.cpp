// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

/// Distances between objects of a scene.
namespace impinge {
namespace {

/// Against the least of the distances of all pairs, near the origin and far from it.
TEST(SceneDistance, IsTheLeastOfThoseOfAllPairs) {
  test::Seeded seeded(10);
  scenes::Random& random = seeded.random;
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(300)), ball = test::mesh_of(scenes::uv_sphere(8, 8, 2));
  const Mesh empty = test::mesh_of({});
  for (const double far : {0.0, 1e6, 0x1p40}) {
    Scene scene;
    std::vector<ObjectId> ids;
    std::vector<Pose> stands;
    const auto pose = [&] {
      Pose one = scenes::random_motion(random, 40);
      one.t[1] += far;
      return one;
    };
    for (int i = 0; i < 14; ++i) {
      stands.push_back(pose());
      ids.push_back(scene.add(i % 2 == 0 ? knot : ball, stands.back(), i % 5).value());
    }
    ASSERT_TRUE(scene.add(empty));
    ASSERT_TRUE(scene.ignore(ids[2], ids[3]));
    const auto expect_least = [&](const std::optional<ObjectDistance>& found, const auto& is_chosen) {
      double least = std::numeric_limits<double>::infinity(), error = 0;
      for (std::uint32_t i = 0; i < ids.size(); ++i)
        for (std::uint32_t k = i + 1; k < ids.size(); ++k) {
          if ((i % 5 != 0 && i % 5 == k % 5) || (i == 2 && k == 3) || !is_chosen(i, k)) continue;
          const Nearest one =
              distance(i % 2 == 0 ? knot : ball, stands[i], k % 2 == 0 ? knot : ball, stands[k]).value();
          if (one.distance < least) least = one.distance, error = one.error;
        }
      ASSERT_TRUE(found);
      EXPECT_LE(std::abs(found->nearest.distance - least), found->nearest.error + error);
      const auto [i, k] = found->objects;
      EXPECT_TRUE(is_chosen(i, k));
      const Nearest pair = distance(i % 2 == 0 ? knot : ball, stands[i], k % 2 == 0 ? knot : ball, stands[k]).value();
      EXPECT_LE(std::abs(found->nearest.distance - pair.distance), found->nearest.error + pair.error);
    };
    expect_least(scene.distance().value(), [](std::uint32_t, std::uint32_t) { return true; });
    for (const std::uint32_t one : {0U, 7U})
      expect_least(scene.distance_with(ids[one]).value(),
                   [&](std::uint32_t i, std::uint32_t k) { return i == one || k == one; });
    const double least = scene.distance()->value().nearest.distance;
    EXPECT_EQ(scene.distance({.stop_above = 0.9 * least})->has_value(), least == 0);
    EXPECT_LT(scene.distance({.enough_below = 2 * least + 1})->value().nearest.distance, 2 * least + 1);
    EXPECT_EQ(scene.distance({.stop_above = -1}).error().code, Code::bad_option);

    const std::array movers{ids[4], ids[9], ids[1]};
    std::vector<Pose> poses;
    for (int i = 0; i < 3 * 80; ++i) poses.push_back(pose());
    const auto found = scene.distance_configurations(movers, poses).value();
    ASSERT_EQ(found.size(), 80u);
    for (std::size_t c = 0; c < found.size(); c += 20) {
      for (std::size_t i = 0; i < 3; ++i) stands[movers[i].index] = poses[3 * c + i];
      const auto moves = [](std::uint32_t i) { return i == 4 || i == 9 || i == 1; };
      expect_least(found[c], [&](std::uint32_t i, std::uint32_t k) { return moves(i) || moves(k); });
    }
  }
  EXPECT_FALSE(Scene().distance()->has_value());
  // Cubes at positions finer than the exact domain, and points, whose squared distance underflows.
  const Mesh cube = test::mesh_of(scenes::cube()), point = test::mesh_of({{0, 0, 0, 0, 0, 0, 0, 0, 0}, {0, 1, 2}});
  for (const double fine : {0x1p-600, 5e-324}) {
    Scene scene, points;
    const ObjectId mover = scene.add(cube, {.t{fine, 0, 0}}).value();
    EXPECT_TRUE(scene.add(cube, {.t{3, fine, 0}}));
    EXPECT_EQ(scene.distance()->value().nearest.distance, 2);
    const std::array poses{Pose{.t{fine, 0, 0}}, Pose{.t{2, fine, 0}}};
    const auto found = scene.distance_configurations(std::array{mover}, poses).value();
    EXPECT_EQ(found[0]->nearest.distance, 2);
    EXPECT_EQ(found[1]->nearest.distance, 0);
    for (const double x : {0.0, fine, 3.0}) EXPECT_TRUE(points.add(point, {.t{x, 0, 0}}));
    const ObjectDistance least = points.distance()->value();
    EXPECT_EQ(least.objects, (std::array<std::uint32_t, 2>{0, 1}));
    EXPECT_GT(least.nearest.distance, 0);
    EXPECT_NEAR(least.nearest.distance, fine, least.nearest.error);
  }
}

/// Cubes along the axes, whose distances are those of intervals: some touch, some are equally near.
TEST(SceneDistance, OfTheClosestPairsIsInOrder) {
  const Mesh cube = test::mesh_of(scenes::cube());
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    test::Seeded seeded(seed);
    Scene scene;
    std::vector<Pose> stands;
    const std::uint32_t grouped = seed < 4 ? 3 : 14;  // the first objects; more than half of them, or fewer
    for (std::uint32_t i = 0; i < 20; ++i) {
      const auto place = [&] { return 0.25 * seeded.random.integer(0, seed % 2 == 0 ? 20 : 60); };
      stands.push_back({.t = {place(), place(), place()}});
      ASSERT_TRUE(scene.add(cube, stands.back(), i < grouped ? 1 : 0));
    }
    const auto gap = [&](std::size_t i, std::size_t k) {
      double square = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double apart = std::max(0.0, std::abs(stands[i].t[axis] - stands[k].t[axis]) - 1);
        square += apart * apart;
      }
      return std::sqrt(square);
    };
    std::vector<double> distances;
    for (std::size_t i = 0; i < stands.size(); ++i)
      for (std::size_t k = std::max<std::size_t>(i + 1, i < grouped ? grouped : 0); k < stands.size(); ++k)
        distances.push_back(gap(i, k));
    std::sort(distances.begin(), distances.end());
    const auto expect_first = [&](std::size_t count, const std::vector<ObjectDistance>& found) {
      ASSERT_EQ(found.size(), std::min(count, distances.size()));
      std::set<std::array<std::uint32_t, 2>> objects;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const auto& [pair, nearest] = found[i];
        EXPECT_LE(std::abs(nearest.distance - distances[i]), nearest.error);
        EXPECT_LE(std::abs(nearest.distance - gap(pair[0], pair[1])), nearest.error);
        EXPECT_TRUE(pair[0] < pair[1] && pair[1] >= grouped && objects.insert({pair[0], pair[1]}).second);
      }
    };
    for (const std::size_t count : {0, 1, 2, 5, 30, 187, 1000}) expect_first(count, scene.closest(count).value());
    const double within = distances[7] + 0.01;
    const auto end = std::upper_bound(distances.begin(), distances.end(), within);
    expect_first(static_cast<std::size_t>(end - distances.begin()), scene.closest(100, {.stop_above = within}).value());
    const auto any = scene.closest(4, {.enough_below = distances[9] + 1}).value();
    for (const ObjectDistance& one : any) EXPECT_LT(one.nearest.distance, distances[9] + 1);
  }
  EXPECT_EQ(Scene().closest(1, {.stop_above = -1}).error().code, Code::bad_option);
}

}  // namespace
}  // namespace impinge
