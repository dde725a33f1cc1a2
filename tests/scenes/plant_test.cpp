// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/plant.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "impinge/io.hpp"
#include "scenes/glb.hpp"
#include "scenes/plant_answer.hpp"
#include "scenes/plant_solids.hpp"
#include "scenes/scene_file.hpp"
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

/// A plant's list against brute force: every pair of every bay.

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
  for (std::uint32_t i = 0; i < parts; ++i)
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

/// The answer that the list itself would be.
std::vector<Clash> right_answer(const Plant& plant) {
  std::vector<Clash> pairs;
  for (const auto& planted : plant.pairs) {
    Clash clash{.objects = {planted.first, planted.second}, .verdict = planted.verdict, .inner = planted.inner};
    clash.nearest = Nearest{.distance = planted.distance.lo};
    pairs.push_back(clash);
  }
  return pairs;
}

class PlantAnswers : public testing::Test {
 protected:
  const Plant plant_ = scenes::plant(600);
  std::vector<Clash> pairs_ = right_answer(plant_);

  [[nodiscard]] std::size_t faults() const { return scenes::compare(plant_, pairs_).faults.size(); }
  std::size_t first_of(Verdict verdict) const {
    const auto place = std::find_if(pairs_.begin(), pairs_.end(), [&](const Clash& c) { return c.verdict == verdict; });
    return static_cast<std::size_t>(place - pairs_.begin());
  }
};

TEST_F(PlantAnswers, TheListItselfIsRight) {
  const auto answer = scenes::compare(plant_, pairs_);
  EXPECT_TRUE(answer.faults.empty());
  std::size_t planted = 0;
  for (const auto& [family, score] : answer.scores) {
    EXPECT_EQ(score.planted, score.right);
    planted += score.planted;
  }
  EXPECT_EQ(planted, plant_.pairs.size());
}

TEST_F(PlantAnswers, WhatIsMissingWrongOrTooMuchIsAFault) {
  const std::vector<Clash> right = pairs_;
  pairs_.erase(pairs_.begin() + 5);
  EXPECT_EQ(faults(), 1u);
  pairs_ = right;
  pairs_.pop_back();
  EXPECT_EQ(faults(), 1u);
  pairs_ = right;
  pairs_[first_of(Verdict::touching)].verdict = Verdict::penetrating;
  EXPECT_EQ(faults(), 1u);
  pairs_ = right;
  Clash& inside = pairs_[first_of(Verdict::inside)];
  inside.inner = 1 - inside.inner;
  EXPECT_EQ(faults(), 1u);
  pairs_ = right;
  Clash& apart = pairs_[first_of(Verdict::apart)];
  apart.nearest->distance = 19.9;
  EXPECT_EQ(faults(), 1u);
  apart.nearest.reset();
  EXPECT_EQ(faults(), 1u);
  pairs_ = right;
  pairs_.push_back({.objects = {598, 599}, .verdict = Verdict::touching});
  EXPECT_EQ(faults(), 1u);
}

TEST_F(PlantAnswers, WithoutAClearanceNothingThatIsApartIsWanted) {
  std::vector<Clash> meeting = pairs_;
  std::erase_if(meeting, [](const Clash& c) { return c.verdict == Verdict::apart; });
  EXPECT_TRUE(scenes::compare(plant_, meeting, {.clearance = 0}).faults.empty());
  EXPECT_EQ(scenes::compare(plant_, pairs_, {.clearance = 0}).faults.size(), pairs_.size() - meeting.size());
}

TEST(Glb, IsReadBackAsItWasWritten) {
  const scenes::Plant plant = scenes::plant(1000, {.seed = 2});
  const auto path = std::filesystem::temp_directory_path() / ("impinge-glb-" + std::to_string(::getpid()) + ".glb");
  std::ofstream(path, std::ios::binary) << scenes::glb_bytes(plant.scene, plant.names);
  const Result<io::Model> model = io::read(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->objects.size(), plant.names.size());
  std::map<std::uint32_t, const MeshState*> shared;
  for (std::size_t i = 0; i < plant.names.size(); ++i) {
    const io::Object& read = model->objects[i];
    const scenes::PlacedObject& object = plant.scene.objects[i];
    const scenes::MeshData& mesh = plant.scene.meshes[object.mesh];
    ASSERT_EQ(read.name, plant.names[i]);
    for (std::size_t k = 0; k < 9; ++k) ASSERT_EQ(read.pose.R[k], static_cast<float>(object.pose.R[k]));
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(read.pose.t[k], static_cast<float>(object.pose.t[k]));
    const auto [place, is_new] = shared.try_emplace(object.mesh, &read.mesh.state());
    ASSERT_EQ(place->second, &read.mesh.state()) << "objects of one mesh do not share it";
    if (!is_new) continue;
    ASSERT_EQ(read.mesh.triangle_count(), mesh.triangle_count());
    ASSERT_EQ(read.mesh.vertex_count(), mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const Point expected{mesh.xyz[3 * v], mesh.xyz[3 * v + 1], mesh.xyz[3 * v + 2]};
      ASSERT_EQ(read.mesh.vertices()[v], expected);  // they are exact in single precision
    }
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(read.mesh.triangles()[t][k], mesh.triangles[3 * t + k]);
  }
}

}  // namespace
}  // namespace impinge
