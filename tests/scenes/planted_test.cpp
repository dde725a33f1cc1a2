// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// A plant's list against brute force: every pair of every bay.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "scenes/plant.hpp"
#include "scenes/plant_answer.hpp"
#include "scenes/plant_solids.hpp"
#include "tests/core/support.hpp"
#include "tests/scenes/relation.hpp"

namespace impinge {
namespace {

using scenes::Plant;
using scenes::PlantPair;

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
  const Plant plant = scenes::plant(800, {.seed = GetParam(), .turned = 0.5});
  Relations relations(plant);
  auto next = plant.pairs.begin();
  const auto parts = static_cast<std::uint32_t>(plant.scene.objects.size());
  for (std::uint32_t i = 0; i < parts; ++i) {
    for (std::uint32_t j = i + 1; j < parts && plant.bays[j] == plant.bays[i]; ++j) {
      const test::Relation& found = relations.of(i, j);
      const std::string both = plant.names[i] + " and " + plant.names[j];
      if (next == plant.pairs.end() || next->first != i || next->second != j) {
        EXPECT_EQ(scenes::in_words(found.verdict, found.inner), "apart") << both;
        EXPECT_GT(found.distance, scenes::kPlantClearance + 1) << both;
        continue;
      }
      const std::string what = both + ": " + std::string(next->family);
      EXPECT_EQ(scenes::in_words(found.verdict, found.inner), scenes::in_words(next->verdict, next->inner)) << what;
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

TEST(PlantedAtFullSize, WhatSharesAPointIsOnTheList) {
  const Plant plant = scenes::plant(10'000, {.turned = 0});
  const Contacts contacts = test::scene_of(plant.scene).collide({.find = Options::Find::first}).value();
  const std::set<std::array<std::uint32_t, 2>> found(contacts.objects.begin(), contacts.objects.end());
  std::size_t listed = 0;
  for (const PlantPair& pair : plant.pairs) {
    const bool is_found = found.contains({pair.first, pair.second});
    listed += is_found ? 1 : 0;
    if (pair.verdict == Verdict::inside) continue;  // with or without contact
    EXPECT_EQ(is_found, pair.verdict != Verdict::apart) << plant.names[pair.first] << ": " << pair.family;
  }
  EXPECT_EQ(listed, found.size());
}

INSTANTIATE_TEST_SUITE_P(Seeds, Planted, testing::Values(1));

}  // namespace
}  // namespace impinge
