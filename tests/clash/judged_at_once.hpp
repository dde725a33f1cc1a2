// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "impinge/clash.hpp"

namespace impinge::test {

struct Pair {
  std::string name;
  Mesh a, b;
  Pose pose_a{}, pose_b{};
};

inline bool fails(const Clash& clash) { return clash.verdict < Verdict::touching; }

/// In one call, by tolerance.
inline Result<std::vector<Clash>> judged_at_once(const Pair& pair, const std::vector<std::optional<double>>& tolerances,
                                                 std::stop_source* stopped_by_terms = nullptr) {
  Scene scene;
  EXPECT_TRUE(scene.add(pair.a, pair.pose_a));
  EXPECT_TRUE(scene.add(pair.b, pair.pose_b));
  ClashOptions options{.threads = 1};
  for (const auto& tolerance : tolerances) options.clearance = std::max(options.clearance, tolerance.value_or(0));
  if (stopped_by_terms != nullptr) options.stop = stopped_by_terms->get_token();
  options.terms = [&](std::uint32_t, std::uint32_t, std::vector<ClashTerms>& terms) {
    for (std::uint32_t i = 0; i < tolerances.size(); ++i) terms.push_back({.tolerance = tolerances[i], .test = i});
    if (stopped_by_terms != nullptr) stopped_by_terms->request_stop();
  };
  std::vector<Clash> clashes(tolerances.size());
  const Result<Clashes> found = find_clashes(scene, options);
  if (!found) return found.error();
  for (const Clash& clash : found->pairs) clashes[clash.test] = clash;
  return clashes;
}

}  // namespace impinge::test
