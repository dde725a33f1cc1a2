// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/partition.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "scenes/shapes.hpp"
#include "tests/paper/batches.hpp"

namespace impinge {
namespace {

using paper::Batch;
using paper::CandidatePair;
using paper::ElementTest;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

bool has_edge(const Triangle& t, const Segment& edge) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Point &p = t[i], &q = t[(i + 1) % 3];
    if ((p == edge[0] && q == edge[1]) || (p == edge[1] && q == edge[0])) return true;
  }
  return false;
}

/// Every index within bounds, every pair with its world triangles, no test and no pair twice, each pair with a test,
/// and each test's edge on its pairs' one side with the triangle on the other.
void expect_consistent(const Batch& batch, const test::LeavesOf& leaves) {
  const std::vector<Triangle> world_a = leaves.world_a(), world_b = leaves.world_b();
  std::set<Pair> pairs, tests;
  std::vector<bool> tested(batch.pairs.size());
  for (const CandidatePair& pair : batch.pairs) {
    ASSERT_TRUE(pairs.emplace(pair.id_a, pair.id_b).second);
    ASSERT_EQ(batch.triangle(pair.triangle_a), world_a[pair.id_a]);
    ASSERT_EQ(batch.triangle(pair.triangle_b), world_b[pair.id_b]);
  }
  for (const ElementTest& test : batch.tests) {
    ASSERT_TRUE(tests.emplace(test.edge, test.triangle).second);
    ASSERT_NE(test.first_pair, ElementTest::kNone);
    const Segment edge{batch.vertices[batch.edges[test.edge][0]], batch.vertices[batch.edges[test.edge][1]]};
    for (const std::uint32_t p : {test.first_pair, test.second_pair}) {
      if (p == ElementTest::kNone) continue;
      tested[p] = true;
      const CandidatePair& pair = batch.pairs[p];
      ASSERT_TRUE(pair.triangle_a == test.triangle || pair.triangle_b == test.triangle);
      const std::uint32_t owner = pair.triangle_a == test.triangle ? pair.triangle_b : pair.triangle_a;
      ASSERT_TRUE(has_edge(batch.triangle(owner), edge));
    }
  }
  ASSERT_TRUE(std::all_of(tested.begin(), tested.end(), [](bool t) { return t; }));
  // Backends turn to each triangle once: its tests follow one another within a leaf pair's stream.
  std::size_t turns = 0;
  for (std::size_t i = 1; i < batch.tests.size(); ++i) turns += batch.tests[i].triangle != batch.tests[i - 1].triangle;
  ASSERT_LE(turns, leaves.pairs().size() * 16);
}

/// Every test of a touching pair whose elements share a point is there, so that one of them can prove it.
void expect_reaches_all(const Batch& batch, const std::vector<test::Contact>& contacts) {
  std::map<Pair, std::size_t> index;
  for (std::size_t i = 0; i < batch.pairs.size(); ++i) index[{batch.pairs[i].id_a, batch.pairs[i].id_b}] = i;
  std::vector<bool> meets(batch.pairs.size());
  for (const ElementTest& test : batch.tests) {
    const Segment edge{batch.vertices[batch.edges[test.edge][0]], batch.vertices[batch.edges[test.edge][1]]};
    if (!intersects(edge, batch.triangle(test.triangle))) continue;
    for (const std::uint32_t p : {test.first_pair, test.second_pair})
      if (p != ElementTest::kNone) meets[p] = true;
  }
  for (const test::Contact& contact : contacts) {
    const auto found = index.find({contact[2], contact[3]});
    ASSERT_NE(found, index.end()) << contact[2] << ' ' << contact[3];
    ASSERT_TRUE(meets[found->second]);
  }
}

TEST(Partition, LetsEveryTouchingPairGoOnOnce) {
  test::Seeded seeded(1);
  std::size_t tests = 0, all = 0;
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 32)) {
    SCOPED_TRACE(named.name);
    const test::LeavesOf leaves(named.scene, 8);
    const Batch batch = leaves.batch();
    expect_consistent(batch, leaves);
    expect_reaches_all(batch, test::brute_force(named.scene));
    tests += batch.tests.size();
    for (const auto& [a, b] : leaves.pairs())
      all += a->edges.size() * b->triangles.size() + b->edges.size() * a->triangles.size();
  }
  EXPECT_LT(tests, all / 2);  // boxes do their work
}

/// Two equal strips of 32 squares in one plane. No element is longer than a square, and more than half of them are as
/// long as that along the strip, so the cells' length is between half a square's and a whole one's. An element is then
/// in up to 3 cells, which the edges of at most 5 squares reach, less than a quarter of them all.
TEST(Partition, FormsPairsOfWhatSharesACellAlone) {
  const test::LeavesOf leaves({{scenes::flat_grid(32, 1)}, {{.mesh = 0}, {.mesh = 0, .pose = {.t = {0.25, 0.25, 0}}}}},
                              64);
  paper::Partitioner partitioner;
  Batch batch;
  partitioner.append(leaves.pairs()[0], leaves.placed(), batch);
  EXPECT_GE(partitioner.shared_cells(), batch.tests.size());
  EXPECT_LT(partitioner.shared_cells(), 2u * 129 * 64 / 4);
  EXPECT_GT(batch.tests.size(), 0u);
}

/// A leaf that comes again keeps its posed elements; what is streamed is the same as with nothing kept.
TEST(Partition, KeepsAPosedLeafWithoutChangingAnything) {
  test::Seeded seeded(2);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 24)) {
    const test::LeavesOf leaves(named.scene, 5);
    const Batch kept = leaves.batch();
    std::size_t next_test = 0, next_pair = 0;
    for (const paper::LeafPair& pair : leaves.pairs()) {
      paper::Partitioner fresh;
      Batch batch;
      fresh.append(pair, leaves.placed(), batch);
      ASSERT_LE(next_test + batch.tests.size(), kept.tests.size());
      ASSERT_LE(next_pair + batch.pairs.size(), kept.pairs.size());
      for (const CandidatePair& p : batch.pairs) {
        EXPECT_EQ(p.id_a, kept.pairs[next_pair].id_a);
        EXPECT_EQ(p.id_b, kept.pairs[next_pair++].id_b);
      }
      for (const ElementTest& test : batch.tests)
        EXPECT_EQ(batch.triangle(test.triangle), kept.triangle(kept.tests[next_test++].triangle));
    }
    EXPECT_EQ(next_test, kept.tests.size());
    EXPECT_EQ(next_pair, kept.pairs.size());
  }
}

TEST(Partition, StartsAnewAfterTheBatchWasCleared) {
  const test::LeavesOf leaves({{scenes::cube()}, {{.mesh = 0}, {.mesh = 0, .pose = {.t = {0.5, 0.5, 0.5}}}}}, 12);
  paper::Partitioner partitioner;
  Batch batch;
  partitioner.append(leaves.pairs()[0], leaves.placed(), batch);
  const std::size_t tests = batch.tests.size(), vertices = batch.vertices.size();
  EXPECT_GT(tests, 0u);
  batch.clear();
  partitioner.restart();
  partitioner.append(leaves.pairs()[0], leaves.placed(), batch);
  EXPECT_EQ(batch.tests.size(), tests);
  EXPECT_EQ(batch.vertices.size(), vertices);
  EXPECT_EQ(vertices, 16u);
}

}  // namespace
}  // namespace impinge
