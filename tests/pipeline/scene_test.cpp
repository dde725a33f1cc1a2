// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/scene.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <optional>
#include <set>

#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using Pair = std::array<std::uint32_t, 2>;

Pose at(double x, double y = 0, double z = 0) {
  Pose pose;
  pose.t = {x, y, z};
  return pose;
}

const Mesh& cube() {
  static const Mesh mesh = test::mesh_of(scenes::cube());
  return mesh;
}

void expect_unknown(const Result<void>& result) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Code::unknown_id);
}

TEST(Scene, KnowsStaleAndForeignIds) {
  Scene scene;
  const ObjectId first = scene.add(cube()).value(), second = scene.add(cube(), at(1)).value();
  EXPECT_EQ(scene.size(), 2u);
  ASSERT_TRUE(scene.remove(first));
  EXPECT_EQ(scene.size(), 1u);
  const ObjectId third = scene.add(cube(), at(1, 1)).value();
  EXPECT_EQ(third.index, first.index);  // used anew
  EXPECT_NE(third, first);
  const ObjectId never{77, 0}, later{third.index, third.generation + 1};
  for (const ObjectId stale : {first, never, later}) {
    expect_unknown(scene.set_pose(stale, {}));
    expect_unknown(scene.remove(stale));
    expect_unknown(scene.ignore(stale, second));
    expect_unknown(scene.ignore(second, stale));
    expect_unknown(scene.unignore(second, stale));
    EXPECT_EQ(scene.pose(stale).error().code, Code::unknown_id);
  }
  EXPECT_NE(scene.remove(first).error().message.find("object 0"), std::string::npos);
  EXPECT_EQ(scene.size(), 2u);
  EXPECT_EQ(scene.pose(third)->t, at(1, 1).t);
  EXPECT_EQ(scene.collide()->objects, std::vector<Pair>({{third.index, second.index}}));
}

TEST(Scene, KeepsItsObjectWhereItWasAfterABadPose) {
  Scene scene;
  const ObjectId id = scene.add(cube(), at(3)).value();
  Pose bad;
  bad.R[0] = 2;
  EXPECT_EQ(scene.set_pose(id, bad).error().code, Code::bad_pose);
  EXPECT_EQ(scene.add(cube(), bad).error().code, Code::bad_pose);
  EXPECT_EQ(scene.size(), 1u);
  EXPECT_EQ(scene.pose(id)->t, at(3).t);
}

TEST(Scene, GroupsAndIgnoredPairsAreLeftOut) {
  Scene scene;
  std::vector<ObjectId> ids;
  for (int i = 0; i < 4; ++i) ids.push_back(scene.add(cube(), {}, i < 2 ? 5 : 0).value());
  const std::vector<Pair> without_group{{0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  EXPECT_EQ(scene.collide()->objects, without_group);
  ASSERT_TRUE(scene.ignore(ids[2], ids[0]));
  ASSERT_TRUE(scene.ignore(ids[0], ids[2]));  // again, the other way round
  EXPECT_EQ(scene.collide()->objects, std::vector<Pair>({{0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  ASSERT_TRUE(scene.unignore(ids[0], ids[2]));
  EXPECT_EQ(scene.collide()->objects, without_group);
  EXPECT_EQ(scene.ignore(ids[1], ids[1]).error().code, Code::bad_option);
  ASSERT_TRUE(scene.ignore(ids[2], ids[3]));
  ASSERT_TRUE(scene.remove(ids[3]));  // takes its ignored pairs along
  const ObjectId anew = scene.add(cube()).value();
  EXPECT_EQ(anew.index, 3u);
  EXPECT_EQ(scene.collide()->objects, without_group);
}

TEST(Scene, MovesAndAnswersTheSameWithAndWithoutUpdate) {
  Scene scene = test::scene_of(scenes::flush_boxes(3, 3, 3));
  const Contacts expected = scene.collide().value();
  EXPECT_EQ(expected.objects.size(), (7u * 7 * 7 - 27) / 2);
  ASSERT_TRUE(scene.update());
  test::expect_same(expected, scene.collide().value());
  Scene taken(std::move(scene));
  test::expect_same(expected, taken.collide().value());
  Scene assigned;
  ASSERT_TRUE(assigned.add(cube()));
  assigned = std::move(taken);
  EXPECT_EQ(assigned.size(), 27u);
  test::expect_same(expected, assigned.collide().value());
}

/// So small a step changes no candidates; the answer is of the new place all the same.
TEST(Scene, AnswersForTheSmallestStepWithoutUpdate) {
  Scene scene;
  ASSERT_TRUE(scene.add(cube()));
  const ObjectId id = scene.add(cube(), at(1)).value();
  ASSERT_TRUE(scene.update());
  EXPECT_EQ(scene.collide()->objects, std::vector<Pair>({{0, 1}}));
  ASSERT_TRUE(scene.set_pose(id, at(1 + 0x1p-50)));
  EXPECT_TRUE(scene.collide()->objects.empty());
  ASSERT_TRUE(scene.set_pose(id, at(1)));
  EXPECT_EQ(scene.collide()->objects, std::vector<Pair>({{0, 1}}));
}

/// Everything a frame may bring, with the broad phase's room for motion outgrown and not: against a scene made anew.
TEST(Scene, MovesAsAFreshSceneWouldStand) {
  test::Seeded seeded(4);
  scenes::Random& random = seeded.random;
  scenes::PlacedScene placed = scenes::scattered(random, scenes::cube(), 60, 6);
  Scene scene = test::scene_of(placed);
  std::size_t contacts = 0;
  for (int frame = 0; frame < 60; ++frame) {
    for (std::uint32_t i = 0; i < placed.objects.size(); ++i) {
      Pose& pose = placed.objects[i].pose;
      for (double& t : pose.t) t += random.uniform(-0.01, 0.01);
      if (random.integer(0, 30) == 0) pose = scenes::random_motion(random, 3);
      ASSERT_TRUE(scene.set_pose({i, 0}, pose));
    }
    if (frame % 3 != 0) {
      ASSERT_TRUE(scene.update());
    }
    const Contacts expected = test::scene_of(placed).collide().value();
    test::expect_same(expected, scene.collide().value());
    contacts += expected.objects.size();
  }
  EXPECT_GT(contacts, 600u);
}

TEST(Scene, TellsWhichObjectIsOutOfRange) {
  Scene scene;
  ASSERT_TRUE(scene.add(cube()));
  const ObjectId far = scene.add(cube(), at(0x1p301)).value();
  const auto result = scene.collide();
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Code::out_of_range);
  EXPECT_NE(result.error().message.find("object 1"), std::string::npos);
  ASSERT_TRUE(scene.remove(far));
  EXPECT_TRUE(scene.collide());
}

TEST(Scene, IsRightOnHardScenes) {
  test::Seeded seeded(1);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random)) {
    SCOPED_TRACE(named.name);
    const auto found = test::scene_of(named.scene).collide();
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(test::listed(*found), test::brute_force(named.scene));
  }
}

/// A random life of a scene against a list kept beside it: adding, moving, removing, ignoring, updating or not.
struct Model {
  struct Entry {
    ObjectId id;
    Pose pose;
    std::uint32_t group;
  };
  std::vector<Entry> entries;
  std::set<std::set<std::uint32_t>> ignored;

  /// Flush unit cubes on the integer lattice touch if and only if no coordinate differs by more than 1.
  [[nodiscard]] std::set<Pair> touching() const {
    std::set<Pair> pairs;
    for (const Entry& p : entries) {
      for (const Entry& q : entries) {
        if (p.id.index >= q.id.index || (p.group != 0 && p.group == q.group)) continue;
        if (ignored.contains({p.id.index, q.id.index})) continue;
        bool near = true;
        for (std::size_t i = 0; i < 3; ++i) near = near && std::abs(p.pose.t[i] - q.pose.t[i]) <= 1;
        if (near) pairs.insert({p.id.index, q.id.index});
      }
    }
    return pairs;
  }
};

RC_GTEST_PROP(Scene, LivesAsItsModelDoes, (const std::vector<std::array<std::uint8_t, 5>>& commands)) {
  Scene scene;
  Model model;
  for (const auto& [what, which, x, y, z] : commands) {
    const Pose pose = at(x % 4, y % 4, z % 4);
    const std::size_t i = model.entries.empty() ? 0 : which % model.entries.size();
    const std::size_t j = model.entries.empty() ? 0 : x % model.entries.size();
    switch (model.entries.empty() ? 0 : what % 8) {
      case 0:
      case 1: {
        const std::uint32_t group = which % 3;
        model.entries.push_back({scene.add(cube(), pose, group).value(), pose, group});
        break;
      }
      case 2:
      case 3:
        RC_ASSERT(scene.set_pose(model.entries[i].id, pose).has_value());
        model.entries[i].pose = pose;
        break;
      case 4: {
        const std::uint32_t gone = model.entries[i].id.index;
        RC_ASSERT(scene.remove(model.entries[i].id).has_value());
        RC_ASSERT(!scene.remove(model.entries[i].id));
        std::erase_if(model.ignored, [&](const auto& pair) { return pair.contains(gone); });
        model.entries.erase(model.entries.begin() + static_cast<std::ptrdiff_t>(i));
        break;
      }
      case 5:
        if (i == j) break;
        RC_ASSERT(scene.ignore(model.entries[i].id, model.entries[j].id).has_value());
        model.ignored.insert({model.entries[i].id.index, model.entries[j].id.index});
        break;
      case 6:
        RC_ASSERT(scene.unignore(model.entries[i].id, model.entries[j].id).has_value());
        model.ignored.erase({model.entries[i].id.index, model.entries[j].id.index});
        break;
      default:
        ASSERT_TRUE(scene.update());
    }
    RC_ASSERT(scene.size() == model.entries.size());
  }
  const auto found = scene.collide({.threads = 1});
  RC_ASSERT(found.has_value());
  const std::set<Pair> expected = model.touching();
  RC_ASSERT(found->objects == std::vector<Pair>(expected.begin(), expected.end()));
}

}  // namespace
}  // namespace impinge
