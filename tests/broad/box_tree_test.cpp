// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "broad/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/scene_view.hpp"
#include "scenes/random.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using broad::BoxTree;
using Pairs = std::vector<std::uint64_t>;

Box random_box(scenes::Random& random) {
  // By whole numbers: many touch exactly.
  const auto whole = [&](int low, int high) { return static_cast<double>(random.integer(low, high)); };
  const Vec3 lo{whole(0, 30), whole(0, 30), whole(0, 30)};
  const double longest = random.integer(0, 20) == 0 ? 30 : 3;
  return {lo, lo + Vec3{whole(0, 3), whole(0, static_cast<int>(longest)), whole(0, 3)}};
}

/// A list kept beside the tree.
struct Model {
  BoxTree tree;
  std::vector<Box> boxes;
  std::vector<std::uint32_t> groups;
  std::vector<bool> is_here;

  void put(std::uint32_t object, const Box& box) {
    tree.put(object, box);
    boxes[object] = box, is_here[object] = true;
  }
  void remove(std::uint32_t object) {
    tree.remove(object);
    is_here[object] = false;
  }
  void build() {
    std::vector<BoxTree::Entry> entries;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      if (is_here[i]) entries.emplace_back(boxes[i], i);
    tree.build(entries);
  }

  void expect_right() {
    std::vector<std::uint32_t> asked;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) asked.push_back(i);  // those that are gone may still ask
    BoxTree::Search of_each, of_all;
    tree.find(asked, boxes, of_each);
    tree.find_pairs(boxes, groups, of_all);
    Pairs &found = of_each.found, &found_pairs = of_all.found, expected, expected_pairs;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      for (std::uint32_t j = 0; j < boxes.size(); ++j) {
        if (!is_here[j] || !overlap(boxes[i], boxes[j])) continue;
        expected.push_back(std::uint64_t{i} << 32 | j);
        if (i < j && is_here[i] && (groups[i] == 0 || groups[i] != groups[j]))
          expected_pairs.push_back(scene::pair_key(i, j));
      }
    std::sort(found.begin(), found.end());
    std::sort(found_pairs.begin(), found_pairs.end());
    ASSERT_EQ(found, expected);
    ASSERT_EQ(found_pairs, expected_pairs);
  }
};

Model random_model(scenes::Random& random, std::uint32_t n) {
  Model model;
  for (std::uint32_t i = 0; i < n; ++i) {
    model.boxes.push_back(random_box(random));
    model.groups.push_back(static_cast<std::uint32_t>(random.integer(0, 3)));
    model.is_here.push_back(random.integer(0, 9) != 0);
  }
  return model;
}

TEST(BoxTree, FindsWhatBruteForceFindsHoweverItWasMade) {
  for (const std::uint32_t n : {0u, 1u, 2u, 8u, 9u, 17u, 64u, 65u, 300u, 1500u}) {
    SCOPED_TRACE(std::to_string(n) + " objects");
    test::Seeded seeded(n);
    Model built = random_model(seeded.random, n);
    built.build();
    built.expect_right();
    built.tree.refit();
    built.expect_right();
    Model grown = random_model(seeded.random, n);
    for (std::uint32_t i = 0; i < n; ++i)
      if (grown.is_here[i]) grown.put(i, grown.boxes[i]);
    grown.expect_right();
    grown.tree.refit();
    grown.expect_right();
  }
}

TEST(BoxTree, StaysRightThroughRandomChanges) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    Model model = random_model(random, 200);
    model.build();
    for (int round = 0; round < 60; ++round) {
      const bool emptying = round >= 30 && round < 35;
      for (int change = 0; change < 60; ++change) {
        const auto i = static_cast<std::uint32_t>(random.integer(0, 199));
        if (emptying || random.integer(0, 3) == 0)
          model.remove(i);
        else if (random.integer(0, 3) == 0)
          model.put(i, random_box(random));
        else  // a small step
          model.put(i, {model.boxes[i].lo + Vec3{1, 0, 0}, model.boxes[i].hi + Vec3{1, 0, 0}});
      }
      if (round % 2 == 0) model.tree.refit();
      model.expect_right();
      if (round % 20 == 19) model.build();
    }
  }
}

TEST(BoxTree, IsTheSameOnEveryInstructionSet) {
  test::Seeded seeded(5);
  Model model = random_model(seeded.random, 500);
  model.build();
  EXPECT_FALSE(test::instruction_sets().empty());
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    model.expect_right();
  }
}

/// Else a scene in which objects come and go would take ever more memory.
TEST(BoxTree, IsWornBeforeItIsMuchLargerThanWhenBuilt) {
  test::Seeded seeded(6);
  Model model = random_model(seeded.random, 400);
  model.build();
  int builds = 0;
  for (int change = 0; change < 20000; ++change) {
    const auto i = static_cast<std::uint32_t>(seeded.random.integer(0, 399));
    model.remove(i);
    model.put(i, random_box(seeded.random));
    if (change % 50 == 0) model.tree.refit();
    if (!model.tree.is_worn()) continue;
    model.build();
    ++builds;
    ASSERT_FALSE(model.tree.is_worn());
  }
  EXPECT_GT(builds, 2);
  EXPECT_LT(builds, 200);
  model.expect_right();
}

}  // namespace
}  // namespace impinge
