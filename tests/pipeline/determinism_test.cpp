// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "tests/core/instruction_sets.hpp"
#include "tests/core/support.hpp"
#include "tests/core/ways.hpp"
#include "tests/pipeline/crowd.hpp"

/// Contract 3.1: one answer. Pairs, kinds, order and hash are the same however they were come by.
namespace impinge {
namespace {

/// With trees that grow for the first time, and ones kept from before, perhaps made for another instruction set.
TEST(Answer, IsTheSameInEveryWay) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  const scenes::PlacedScene placed = test::crowd(2);
  const Contacts expected = test::scene_of(placed).collide({.backend = "paper"}).value();
  EXPECT_GT(expected.triangles.size(), 3000u);
  std::map<std::uint32_t, Scene> kept;
  std::size_t number = 0;
  const std::vector<test::Way>& ways = test::all_ways();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const test::Way& way = ways[i];
    SCOPED_TRACE(way.name());
    const test::OnInstructionSet on(way.instruction_set);
    const auto [scene, is_new] = kept.try_emplace(way.leaf_size);
    if (is_new) scene->second = test::scene_of(placed, way.leaf_size);
    test::expect_same(expected, scene->second.collide(way.options()).value());
    if (++number % 5 == 0)
      test::expect_same(expected, test::scene_of(placed, way.leaf_size).collide(way.options()).value());
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Answer, IsThatOfBruteForceOnACrowd) {
  scenes::PlacedScene placed = test::crowd(3);
  std::erase_if(placed.objects, [&](const auto& o) { return placed.meshes[o.mesh].triangle_count() > 1000; });
  for (const char* backend : {"simd", "paper"})
    EXPECT_EQ(test::listed(test::scene_of(placed).collide({.backend = backend}).value()), test::brute_force(placed));
}

/// Renumbered objects give renumbered rows, triangles exchanged where the order of two objects turned, and the same
/// hash.
TEST(Answer, DependsOnTheOrderOfObjectsInItsNamesAlone) {
  const scenes::PlacedScene placed = test::crowd(4);
  const Contacts expected = test::scene_of(placed).collide().value();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    test::Seeded seeded(seed);
    std::vector<std::uint32_t> order(placed.objects.size());  // new place -> old place
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[static_cast<std::size_t>(seeded.random.integer(0, static_cast<int>(i) - 1))]);
    scenes::PlacedScene shuffled = placed;
    for (std::size_t i = 0; i < order.size(); ++i) shuffled.objects[i] = placed.objects[order[i]];
    const Contacts found = test::scene_of(shuffled).collide().value();
    EXPECT_EQ(found.hash, expected.hash);
    std::vector<test::Contact> renamed = test::listed(found);
    for (test::Contact& c : renamed) {
      c[0] = order[c[0]], c[1] = order[c[1]];
      if (c[0] > c[1]) std::swap(c[0], c[1]), std::swap(c[2], c[3]);
    }
    std::sort(renamed.begin(), renamed.end());
    EXPECT_EQ(renamed, test::listed(expected));
  }
}

TEST(Answer, IsTransposedWhenTheMeshesAreSwapped) {
  test::Seeded seeded(5);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 40)) {
    SCOPED_TRACE(named.name);
    const std::vector<Mesh> meshes = test::meshes_of(named.scene);
    const auto &a = named.scene.objects[0], &b = named.scene.objects[1];
    const Contacts ab = collide(meshes[a.mesh], a.pose, meshes[b.mesh], b.pose).value();
    const Contacts ba = collide(meshes[b.mesh], b.pose, meshes[a.mesh], a.pose).value();
    EXPECT_EQ(ab.hash, ba.hash);
    EXPECT_EQ(test::transposed(test::listed(ab)), test::listed(ba));
    // A scene of the two is the same question.
    test::expect_same(ab, test::scene_of(named.scene).collide().value());
  }
}

}  // namespace
}  // namespace impinge
