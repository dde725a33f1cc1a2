// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/plant.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "scenes/scene_file.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"
#include "tests/scenes/relation.hpp"

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

/// A pose as seen from another one, with the roundings of a turned bay taken off: a bay's parts stand at multiples of a
/// quarter turn and of 2^-10 to each other.
Pose seen_from(const Pose& from, const Pose& pose) {
  Pose seen;
  for (std::size_t i = 0; i < 3; ++i) {
    double t = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      t += from.R[3 * k + i] * (pose.t[k] - from.t[k]);
      double r = 0;
      for (std::size_t j = 0; j < 3; ++j) r += from.R[3 * j + i] * pose.R[3 * j + k];
      seen.R[3 * i + k] = std::round(r);
      EXPECT_NEAR(r, seen.R[3 * i + k], 1e-14);
    }
    seen.t[i] = scenes::snapped(t);
    EXPECT_NEAR(t, seen.t[i], 1e-9);
  }
  return seen;
}

/// Relations by brute force, each of what is alike once.
class Relations {
 public:
  explicit Relations(const Plant& plant) : plant_(plant) {}

  const test::Relation& of(std::uint32_t i, std::uint32_t j) {
    const auto& a = plant_.scene.objects[i];
    const auto& b = plant_.scene.objects[j];
    const Pose pose = seen_from(a.pose, b.pose);
    const auto [place, is_new] = known_.try_emplace({a.mesh, b.mesh, pose.R, pose.t});
    if (is_new) {
      const auto& meshes = plant_.scene.meshes;
      place->second = test::relation(meshes[a.mesh], {}, meshes[b.mesh], pose, scenes::kPlantClearance + 4);
    }
    return place->second;
  }

 private:
  const Plant& plant_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::array<double, 9>, std::array<double, 3>>, test::Relation>
      known_;
};

class Planted : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Planted, NoMoreAndNoLessThanTheList) {
  SCOPED_TRACE("seed " + std::to_string(GetParam()));
  const Plant plant = scenes::plant(1200, {.seed = GetParam(), .turned = 0.5});
  Relations relations(plant);
  auto next = plant.pairs.begin();
  const auto parts = static_cast<std::uint32_t>(plant.scene.objects.size());
  for (std::uint32_t i = 0; i < parts; ++i) {
    for (std::uint32_t j = i + 1; j < parts && plant.bays[j] == plant.bays[i]; ++j) {
      const test::Relation& found = relations.of(i, j);
      const std::string both = plant.names[i] + " and " + plant.names[j];
      if (next == plant.pairs.end() || next->first != i || next->second != j) {
        EXPECT_EQ(found.verdict, Verdict::apart) << both;
        EXPECT_GT(found.distance, scenes::kPlantClearance + 1) << both;
        continue;
      }
      const std::string what = both + ": " + std::string(next->family);
      EXPECT_EQ(found.verdict, next->verdict) << what;
      EXPECT_EQ(found.inner, next->inner) << what;
      if (next->verdict == Verdict::apart) {
        EXPECT_GE(found.distance, next->distance.lo - 1e-9) << what;
        EXPECT_LE(found.distance, next->distance.hi + 1e-9) << what;
        EXPECT_GE(next->distance.lo, 0.5) << what;
        EXPECT_LE(next->distance.hi, scenes::kPlantClearance - 1) << what;
      }
      ++next;
    }
  }
  EXPECT_EQ(next, plant.pairs.end());
}

INSTANTIATE_TEST_SUITE_P(Seeds, Planted, testing::Range<std::uint64_t>(1, 5));

}  // namespace
}  // namespace impinge
