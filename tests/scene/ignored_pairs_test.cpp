// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene/ignored_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "scenes/random.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

TEST(IgnoredPairs, AreThoseOfASetOfSets) {
  test::Seeded seeded(1);
  scenes::Random& random = seeded.random;
  scene::IgnoredPairs pairs;
  std::set<std::set<std::uint32_t>> expected;
  EXPECT_TRUE(pairs.empty());
  EXPECT_FALSE(pairs.contains(3, 4));
  pairs.erase(3, 4), pairs.erase_all_of(5);
  constexpr std::uint32_t n = 20;
  for (int change = 0; change < 3000; ++change) {
    const auto a = static_cast<std::uint32_t>(random.integer(0, n - 1));
    const std::uint32_t b = (a + static_cast<std::uint32_t>(random.integer(1, n - 1))) % n;
    const int what = random.integer(0, 9);
    if (what < 6) {
      pairs.insert(a, b), expected.insert({a, b});
    } else if (what < 9) {
      pairs.erase(a, b), expected.erase({a, b});
    } else {
      pairs.erase_all_of(a);
      std::erase_if(expected, [&](const auto& pair) { return pair.contains(a); });
    }
    EXPECT_EQ(pairs.empty(), expected.empty());
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; j < n; ++j)
        if (i != j) {
          ASSERT_EQ(pairs.contains(i, j), expected.contains({i, j})) << i << ' ' << j;
        }
  }
  EXPECT_FALSE(pairs.contains(0, 1000));
}

/// By the rule of `Filter` for each pair; named pairs stay what they are meanwhile.
TEST(IgnoredPairs, AreThoseWhoseFiltersDisagree) {
  test::Seeded seeded(2);
  scenes::Random& random = seeded.random;
  constexpr std::uint32_t n = 12;
  std::array<Filter, n> filters;
  scene::IgnoredPairs pairs;
  pairs.insert(1, 2);
  for (int change = 0; change < 500; ++change) {
    const auto object = static_cast<std::uint32_t>(random.integer(3, n - 1));
    filters[object] = {random.bits() & random.bits() & 15, random.bits() & 15};
    if (random.integer(0, 5) == 0) {
      filters[object] = {};
      pairs.erase_all_of(object);
    } else {
      pairs.set_filter(object, filters[object]);
    }
    EXPECT_FALSE(pairs.empty());
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t k = 0; k < n; ++k) {
        if (i == k) continue;
        const bool agree = (filters[i].mask & filters[k].category) != 0 && (filters[k].mask & filters[i].category) != 0;
        ASSERT_EQ(pairs.contains(i, k), !agree || (std::min(i, k) == 1 && std::max(i, k) == 2)) << i << ' ' << k;
      }
  }
}

/// One that ignores all others has them forgotten one by one in no time.
TEST(IgnoredPairs, OfOneObjectAreForgottenWithoutALookAtTheOthers) {
  scene::IgnoredPairs pairs;
  constexpr std::uint32_t n = 20000;
  for (std::uint32_t i = 1; i < n; ++i) pairs.insert(0, i), pairs.insert(i, n + i);
  for (std::uint32_t i = 1; i < n; ++i) pairs.erase_all_of(i);
  EXPECT_TRUE(pairs.empty());
}

}  // namespace
}  // namespace impinge
