// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/plant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

#include "scenes/plant_solids.hpp"
#include "scenes/scene_file.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::Plant;
using scenes::PlantPair;

std::size_t triangles_of(const Plant& plant) {
  std::size_t count = 0;
  for (const auto& object : plant.scene.objects) count += plant.scene.meshes[object.mesh].triangle_count();
  return count;
}

TEST(Plant, HasSoManyPartsWithNamesOfTheirOwn) {
  for (const int parts : {1, 7, 100, 1000, 10'000}) {
    const Plant plant = scenes::plant(parts);
    EXPECT_EQ(plant.scene.objects.size(), static_cast<std::size_t>(parts));
    EXPECT_EQ(plant.bays.size(), plant.names.size());
    EXPECT_EQ(std::set<std::string>(plant.names.begin(), plant.names.end()).size(), plant.scene.objects.size());
  }
}

TEST(Plant, TenThousandPartsAreFiveMillionTriangles) {
  const Plant plant = scenes::plant(10'000);
  EXPECT_GT(triangles_of(plant), 4'500'000u);
  EXPECT_LT(triangles_of(plant), 5'500'000u);
  EXPECT_LT(plant.scene.meshes.size(), 500u);
}

TEST(Plant, IsTheSameAgainAndAnotherByAnotherSeed) {
  const auto bytes = [](std::uint64_t seed) { return scenes::scene_bytes(scenes::plant(500, {.seed = seed}).scene); };
  EXPECT_EQ(bytes(1), bytes(1));
  EXPECT_NE(bytes(1), bytes(2));
}

TEST(Plant, ListsEachPairOnceInOrder) {
  const Plant plant = scenes::plant(10'000, {.seed = 3});
  for (std::size_t i = 0; i < plant.pairs.size(); ++i) {
    const PlantPair& pair = plant.pairs[i];
    ASSERT_LT(pair.first, pair.second);
    ASSERT_EQ(plant.bays[pair.first], plant.bays[pair.second]);
    ASSERT_EQ(pair.inner >= 0, pair.verdict == Verdict::inside);
    ASSERT_EQ(pair.distance.hi > 0, pair.verdict == Verdict::apart);
    ASSERT_LE(pair.distance.lo, pair.distance.hi);
    if (i == 0) continue;
    const PlantPair& last = plant.pairs[i - 1];
    ASSERT_LT(std::pair(last.first, last.second), std::pair(pair.first, pair.second));
  }
}

TEST(Plant, BaysKeepToTheirSlots) {
  constexpr double kSlot = 8000, kReach = 3900;
  const Plant plant = scenes::plant(5000, {.seed = 4, .turned = 0.5});
  std::map<std::uint32_t, std::array<double, 3>> slots;
  for (std::size_t i = 0; i < plant.scene.objects.size(); ++i) {
    const auto& object = plant.scene.objects[i];
    const auto& xyz = plant.scene.meshes[object.mesh].xyz;
    for (std::size_t v = 0; v < xyz.size(); v += 3) {
      const Point p = world_vertex(object.pose, {xyz[v], xyz[v + 1], xyz[v + 2]});
      const auto middle = [](double x) { return (std::floor(x / kSlot) + 0.5) * kSlot; };
      const std::array<double, 3> slot{middle(p.x), middle(p.y), middle(p.z)};
      ASSERT_EQ(slots.try_emplace(plant.bays[i], slot).first->second, slot) << plant.names[i];
      ASSERT_LT(std::hypot(p.x - slot[0], p.y - slot[1], p.z - slot[2]), kReach) << plant.names[i];
    }
  }
  std::set<std::array<double, 3>> different;
  for (const auto& [bay, slot] : slots) different.insert(slot);
  EXPECT_EQ(different.size(), slots.size());
  EXPECT_EQ(different.size(), plant.is_turned.size());
}

TEST(Plant, UprightBaysAndAllMeshesAreExactInSinglePrecision) {
  const Plant plant = scenes::plant(5000, {.seed = 6});
  for (const auto& mesh : plant.scene.meshes)
    for (const double x : mesh.xyz) ASSERT_EQ(static_cast<double>(static_cast<float>(x)), x);
  std::size_t upright = 0;
  for (std::size_t i = 0; i < plant.scene.objects.size(); ++i) {
    if (plant.is_turned[plant.bays[i]]) continue;
    ++upright;
    for (const double r : plant.scene.objects[i].pose.R) ASSERT_TRUE(r == 0 || r == 1 || r == -1);
    for (const double t : plant.scene.objects[i].pose.t) ASSERT_EQ(scenes::snapped(t), t);
  }
  EXPECT_GT(upright, 1000u);
}

}  // namespace
}  // namespace impinge
