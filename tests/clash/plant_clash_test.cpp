// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The verdicts on a plant's parts, no more and no less than were planted.
#include <gtest/gtest.h>

#include <string>

#include "impinge/clash.hpp"
#include "scenes/plant.hpp"
#include "scenes/plant_answer.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

/// Distances in a turned bay are off by roundings of 2^-53 of its coordinates.
constexpr double kSlack = 1e-6;

void expect_right(const scenes::Plant& plant, const ClashOptions& options) {
  const Result<Clashes> clashes = find_clashes(test::scene_of(plant.scene), options);
  ASSERT_TRUE(clashes) << clashes.error().message;
  for (std::size_t i = 0; i < clashes->parts.size(); ++i)
    EXPECT_EQ(clashes->parts[i].part_class, PartClass::solid) << plant.names[i];
  const auto answer = scenes::compare(plant, clashes->pairs, {.clearance = options.clearance, .slack = kSlack});
  for (const std::string& fault : answer.faults) ADD_FAILURE() << fault;
}

TEST(PlantClash, FindsWhatWasPlanted) {
  expect_right(scenes::plant(700, {.seed = 1, .turned = 0.5}), {.clearance = scenes::kPlantClearance});
}

TEST(PlantClash, FindsItWithoutAClearance) { expect_right(scenes::plant(400, {.seed = 2, .turned = 0.5}), {}); }

TEST(PlantClash, NeedsNoToleranceWhereNothingIsTurned) {
  expect_right(scenes::plant(500, {.seed = 3, .turned = 0}), {.tolerance = 0, .clearance = scenes::kPlantClearance});
}

}  // namespace
}  // namespace impinge
