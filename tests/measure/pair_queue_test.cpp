// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "measure/pair_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "tests/core/support.hpp"

namespace impinge {
namespace {

using measure::NodePair;
using measure::PairQueue;

/// The depth says which it is.
NodePair pair_at(double lower, std::uint16_t name) { return {lower, {}, {}, NodePair::kSelf, NodePair::kSelf, name}; }

TEST(PairQueue, GivesBackEachPairOnceAndTheNearerAboutFirst) {
  PairQueue::Stacks stacks;
  test::Seeded seeded(11);
  for (const double limit : {1.0, 0x1p-1000, 0x1p300, 0.0, std::numeric_limits<double>::infinity()}) {
    const double range = std::isfinite(limit) ? limit : 1;
    std::multiset<std::uint16_t> waiting;
    std::uint16_t name = 0;
    std::vector<NodePair> first;
    const auto fresh = [&] {
      waiting.insert(++name);
      return pair_at(range * seeded.random.unit(), name);
    };
    for (int i = 0; i < 20; ++i) first.push_back(fresh());
    double least = limit;
    for (const NodePair& pair : first) least = std::min(least, pair.lower);
    PairQueue queue(stacks, first, limit);
    std::vector<double> lower;  // of those that wait; nearer ones may come at any time
    for (const NodePair& pair : first) lower.push_back(pair.lower);
    for (int i = 0; i < 3000 && !waiting.empty(); ++i) {
      if (i < 1000 && seeded.random.integer(0, 2) > 0) {
        const NodePair pair = fresh();
        lower.push_back(pair.lower);
        queue.push(pair);
        continue;
      }
      const auto next = queue.pop();
      ASSERT_TRUE(next);
      ASSERT_EQ(waiting.erase(next->depth), 1u);
      if (limit > 0 && std::isfinite(limit)) {
        EXPECT_LE(next->lower, std::max(least, *std::min_element(lower.begin(), lower.end())) + 1.01 * range / 32);
      }
      lower.erase(std::find(lower.begin(), lower.end(), next->lower));
    }
    EXPECT_TRUE(waiting.empty());
    EXPECT_FALSE(queue.pop());
  }
}

/// Each test lowers the limit to a little more than its bound, as the distance found would: the first one by so much
/// that only some of the pairs are near, later ones until none is that is left.
TEST(NearestFirst, TestsWhatIsNearAndTheLeastBoundFirst) {
  test::Seeded seeded(12);
  std::size_t passed_over = 0;  // pairs that were near after the first test, and no longer when their turn came
  for (int size = 0; size < 40; ++size) {
    std::vector<measure::NearTriangles> near;
    std::vector<double> found;  // by name
    for (int i = 0; i < size; ++i) {
      near.push_back({seeded.random.uniform(-0.2, 1), static_cast<std::uint16_t>(i), 0});
      found.push_back(near.back().lower + seeded.random.uniform(0, 0.6));
    }
    std::vector<measure::NearTriangles> sorted = near;
    std::sort(sorted.begin(), sorted.end(), [](const auto& p, const auto& q) { return p.lower < q.lower; });
    std::vector<std::uint16_t> expected, tested;
    double limit = 0.9, after_first = limit;
    for (const auto& pair : sorted) {
      passed_over += pair.lower > limit && pair.lower <= after_first ? 1 : 0;
      if (pair.lower > limit) continue;
      expected.push_back(pair.a), limit = std::min(limit, found[pair.a]);
      if (expected.size() == 1) after_first = limit;
    }
    limit = 0.9;
    measure::nearest_first(
        near, [&](const auto& pair) { return pair.lower <= limit; },
        [&](const auto& pair) { tested.push_back(pair.a), limit = std::min(limit, found[pair.a]); });
    EXPECT_EQ(tested, expected);
  }
  EXPECT_GT(passed_over, 0u);
}

}  // namespace
}  // namespace impinge
