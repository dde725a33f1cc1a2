// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/plant_answer.hpp"

namespace impinge {
namespace {

using scenes::Plant;

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

}  // namespace
}  // namespace impinge
