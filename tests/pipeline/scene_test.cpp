// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/scene.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using Pair = std::array<std::uint32_t, 2>;

Pose at(double x, double y = 0, double z = 0) { return {.t = {x, y, z}}; }

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
  EXPECT_EQ(scene.id(0).value(), third);
  EXPECT_EQ(scene.id(2).error().code, Code::unknown_id);
  EXPECT_NE(third, first);
  const ObjectId never{77, 0}, later{third.index, third.generation + 1};
  Scene other;
  const ObjectId foreign = other.add(cube()).value();
  EXPECT_EQ(foreign.index, third.index);
  for (const ObjectId stale : {first, never, later, foreign, ObjectId{}}) {
    expect_unknown(scene.set_pose(stale, {}));
    expect_unknown(scene.remove(stale));
    expect_unknown(scene.ignore(stale, second));
    expect_unknown(scene.ignore(second, stale));
    expect_unknown(scene.unignore(second, stale));
    expect_unknown(scene.set_poses(std::array{second, stale}, std::array{at(9), at(9)}));
    EXPECT_EQ(scene.pose(stale).error().code, Code::unknown_id);
    EXPECT_EQ(scene.collide_with(stale).error().code, Code::unknown_id);
    EXPECT_EQ(scene.collide_configurations({&stale, 1}, {}).error().code, Code::unknown_id);
  }
  EXPECT_EQ(scene.pose(second)->t, at(1).t) << "nothing half done";
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
  EXPECT_EQ(scene.set_poses(std::array{id, id}, std::array{at(5), bad}).error().message.substr(0, 9), "poses[1]:");
  EXPECT_EQ(scene.set_poses(std::array{id, id}, std::array{at(5)}).error().code, Code::bad_option);
  EXPECT_EQ(scene.pose(id)->t, at(3).t);
}

TEST(Scene, CopiesLiveOnTheirOwn) {
  Scene scene;
  const ObjectId a = scene.add(cube()).value(), b = scene.add(cube(), at(1)).value();
  ASSERT_TRUE(scene.update());
  Scene copy = scene;
  ASSERT_TRUE(copy.set_pose(b, at(2)));
  EXPECT_TRUE(copy.collide()->objects.empty());
  EXPECT_EQ(scene.collide()->objects, std::vector<Pair>({{0, 1}}));
  ASSERT_TRUE(scene.remove(a));
  copy = scene;
  EXPECT_EQ(copy.size(), 1u);
  expect_unknown(copy.set_pose(a, {}));
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
  Scene scene;
  std::vector<ObjectId> ids;
  const Mesh mesh = test::mesh_of(placed.meshes[0]);
  for (const auto& object : placed.objects) ids.push_back(scene.add(mesh, object.pose).value());
  std::size_t contacts = 0;
  for (int frame = 0; frame < 60; ++frame) {
    for (std::uint32_t i = 0; i < placed.objects.size(); ++i) {
      Pose& pose = placed.objects[i].pose;
      for (double& t : pose.t) t += random.uniform(-0.01, 0.01);
      if (random.integer(0, 30) == 0) pose = scenes::random_motion(random, 3);
      ASSERT_TRUE(scene.set_pose(ids[i], pose));
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

TEST(Scene, DeformsOneObjectAndNoOtherOfItsMesh) {
  Scene scene;
  const ObjectId first = scene.add(cube(), at(0)).value(), second = scene.add(cube(), at(1.5), 7).value();
  std::vector<double> wide = scenes::cube().xyz;
  for (std::size_t i = 0; i < wide.size(); i += 3) wide[i] *= 2;
  ASSERT_TRUE(scene.set_vertices(first, wide));
  const Mesh expected = test::mesh_of({wide, scenes::cube().triangles});
  test::expect_same(collide(expected, at(0), cube(), at(1.5)).value(), scene.collide().value());
  EXPECT_EQ(scene.pose(first)->t, at(0).t);
  EXPECT_TRUE(scene.collide_with(cube(), at(3.5))->objects.empty());
  wide[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(scene.set_vertices(second, wide).error().code, Code::bad_mesh);
  EXPECT_EQ(scene.set_vertices({77, 0}, wide).error().code, Code::unknown_id);
  test::expect_same(collide(expected, at(0), cube(), at(1.5)).value(), scene.collide().value());
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

/// A random life of a scene against a list kept beside it: adding, moving, removing, ignoring, updating or not.
struct Model {
  struct Entry {
    ObjectId id;
    Pose pose;
    std::uint32_t group;
    Filter filter{};
  };
  std::vector<Entry> entries;
  std::set<std::set<std::uint32_t>> ignored;

  /// Flush unit cubes on the integer lattice touch if and only if no coordinate differs by more than 1. Pairs of which
  /// neither is chosen are left out.
  template <class Chosen>
  [[nodiscard]] std::vector<Pair> touching(const Chosen& is_chosen) const {
    std::set<Pair> pairs;
    for (const Entry& p : entries)
      for (const Entry& q : entries) {
        if (p.id.index >= q.id.index || (p.group != 0 && p.group == q.group)) continue;
        if (ignored.contains({p.id.index, q.id.index}) || !(is_chosen(p) || is_chosen(q))) continue;
        if ((p.filter.mask & q.filter.category) == 0 || (q.filter.mask & p.filter.category) == 0) continue;
        bool near = true;
        for (std::size_t i = 0; i < 3; ++i) near = near && std::abs(p.pose.t[i] - q.pose.t[i]) <= 1;
        if (near) pairs.insert({p.id.index, q.id.index});
      }
    return {pairs.begin(), pairs.end()};
  }
  /// Whether a cube at this pose, which is not in the scene, touches any.
  [[nodiscard]] bool has_any_at(const Pose& pose) const {
    return std::any_of(entries.begin(), entries.end(), [&](const Entry& one) {
      return std::equal(pose.t.begin(), pose.t.end(), one.pose.t.begin(),
                        [](double x, double y) { return std::abs(x - y) <= 1; });
    });
  }
};

/// All questions to the scene, and of a guest beside each of its objects, with each number of its objects moved in
/// turn.
void expect_as_model(const Scene& scene, const Model& model) {
  const auto all = [](const Model::Entry&) { return true; };
  const std::vector<Pair> expected = model.touching(all);
  RC_ASSERT(scene.collide({.threads = 1})->objects == expected);
  RC_ASSERT(scene.touches_any().value() == !expected.empty());
  std::vector<ObjectId> movers;
  for (const Model::Entry& entry : model.entries) {
    RC_ASSERT(scene.collide_with(entry.id, {.threads = 1})->objects ==
              model.touching([&](const Model::Entry& one) { return one.id == entry.id; }));
    Pose guest = entry.pose;
    guest.t[0] += 2;
    RC_ASSERT(scene.touches_with(cube(), guest).value() == model.has_any_at(guest));
    RC_ASSERT(!scene.touches_with(Mesh::create(std::span<const double>(), {}).value(), guest).value());
    movers.push_back(entry.id);
    Model moved = model;
    std::vector<Pose> poses;
    std::vector<std::vector<Pair>> touching;
    for (int configuration = 0; configuration < 3; ++configuration) {
      for (std::size_t i = 0; i < movers.size(); ++i) {
        double& x = moved.entries[i].pose.t[i % 3];
        x = static_cast<int>(x + configuration + 2) % 6;
        poses.push_back(moved.entries[i].pose);
      }
      const auto moves = [&](const Model::Entry& one) {
        return std::find(movers.begin(), movers.end(), one.id) != movers.end();
      };
      touching.push_back(moved.touching(moves));
    }
    const Configurations found = scene.collide_configurations(movers, poses, {.witnesses = true}).value();
    for (std::size_t i = 0; i < 3; ++i) {
      RC_ASSERT((found.touches[i] != 0) == !touching[i].empty());
      RC_ASSERT(found.witnesses[i].has_value() == !touching[i].empty());
      if (found.witnesses[i])
        RC_ASSERT(std::count(touching[i].begin(), touching[i].end(), found.witnesses[i]->objects) == 1);
    }
    const auto first = scene.first_touching(movers, poses).value();
    RC_ASSERT(first.has_value() == (found.touches != std::vector<std::uint8_t>(3)));
    if (first) RC_ASSERT(found.touches[*first] == 1);
  }
}

RC_GTEST_PROP(Scene, LivesAsItsModelDoes, (const std::vector<std::array<std::uint8_t, 5>>& commands)) {
  Scene scene;
  Model model;
  for (const auto& [what, which, x, y, z] : commands) {
    const Pose pose = at(x % 4, y % 4, z % 4);
    const std::size_t i = model.entries.empty() ? 0 : which % model.entries.size();
    const std::size_t j = model.entries.empty() ? 0 : x % model.entries.size();
    switch (model.entries.empty() ? 0 : what % 9) {
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
      case 7:
        model.entries[i].filter = {std::uint64_t{1} << (y % 3), std::uint64_t{z} % 8};
        RC_ASSERT(scene.set_filter(model.entries[i].id, model.entries[i].filter).has_value());
        break;
      default:
        ASSERT_TRUE(scene.update());
    }
    RC_ASSERT(scene.size() == model.entries.size());
  }
  expect_as_model(scene, model);
}

/// Knots that touch in all ways, many configurations on many threads: as `collide` on scenes moved there, whose
/// witnesses are contacts.
TEST(Scene, AnswersConfigurationsAsIfItsObjectsStoodThere) {
  test::Seeded seeded(9);
  scenes::Random& random = seeded.random;
  const scenes::PlacedScene placed = scenes::scattered(random, scenes::torus_knot_of(968), 12, 14);
  Scene scene;
  const Mesh knot = test::mesh_of(placed.meshes[0]), ball = test::mesh_of(scenes::uv_sphere(8, 8, 2));
  for (const auto& object : placed.objects) ASSERT_TRUE(scene.add(knot, object.pose, 1));
  std::vector<ObjectId> movers;
  for (int i = 0; i < 3; ++i) movers.push_back(scene.add(i == 1 ? ball : knot).value());
  ASSERT_TRUE(scene.ignore(movers[0], movers[2]));
  std::vector<Pose> poses;
  for (int i = 0; i < 3 * 300; ++i) poses.push_back(scenes::random_motion(random, 18));
  const Configurations found = scene.collide_configurations(movers, poses, {.witnesses = true}).value();
  EXPECT_EQ(scene.collide_configurations(movers, poses, {.threads = 1})->touches, found.touches);
  std::size_t touching = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    ASSERT_TRUE(scene.set_poses(movers, std::span(poses).subspan(3 * i, 3)));
    if (i % 64 < 32) {  // the movers jump; else they have left their boxes, or rest
      ASSERT_TRUE(scene.update());
    }
    const Contacts contacts = scene.collide().value();
    ASSERT_EQ(found.touches[i] != 0, !contacts.objects.empty()) << i;
    EXPECT_EQ(scene.touches_any().value(), !contacts.objects.empty());
    if (contacts.objects.empty()) continue;
    ++touching;
    const Touch& touch = *found.witnesses[i];
    const auto row = std::find(contacts.objects.begin(), contacts.objects.end(), touch.objects);
    ASSERT_NE(row, contacts.objects.end());
    const auto at_row = static_cast<std::size_t>(row - contacts.objects.begin());
    EXPECT_EQ(std::count(contacts.triangles.begin() + static_cast<std::ptrdiff_t>(contacts.offsets[at_row]),
                         contacts.triangles.begin() + static_cast<std::ptrdiff_t>(contacts.offsets[at_row + 1]),
                         touch.triangles),
              1);
    // A guest stands where the mover does; it is of no group and ignores nothing.
    const Contacts of_guest = scene.collide_with(ball, poses[3 * i + 1]).value();
    Scene with_guest = scene;
    EXPECT_EQ(scene.touches_with(ball, poses[3 * i + 1]).value(), !of_guest.objects.empty());
    const ObjectId guest = with_guest.add(ball, poses[3 * i + 1]).value();
    const Contacts of_object = with_guest.collide_with(guest).value();
    EXPECT_EQ(of_guest.triangles, of_object.triangles);
    EXPECT_EQ(of_guest.hash, of_object.hash);
    for (const auto& [object, last] : of_guest.objects) EXPECT_EQ(last, 0xFFFFFFFF);
  }
  EXPECT_GT(touching, 50u);
  EXPECT_LT(touching, 250u);
}

/// No tree is made, of however many pairs.
TEST(Scene, IsNotSearchedAfterAStop) {
  const Mesh ball = test::mesh_of(scenes::uv_sphere(24, 16)), guest = test::mesh_of(scenes::uv_sphere(24, 16));
  const std::size_t without_trees = ball.memory_bytes();
  std::stop_source stop;
  stop.request_stop();
  Scene scene;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(scene.add(ball, at(0.001 * i)));
    for (const int threads : {1, 2}) {
      const ConfigurationOptions options{.threads = threads, .stop = stop.get_token()};
      EXPECT_EQ(scene.touches_with(guest, {}, options).error().code, Code::cancelled);
      EXPECT_EQ(scene.touches_any(options).error().code, Code::cancelled);
    }
  }
  EXPECT_EQ(collide(ball, {}, guest, {}, {.stop = stop.get_token()}).error().code, Code::cancelled);
  EXPECT_EQ(ball.memory_bytes() + guest.memory_bytes(), 2 * without_trees);
}

TEST(Scene, SaysWhichConfigurationIsWrong) {
  Scene scene;
  const std::array ids{scene.add(cube()).value(), scene.add(cube(), at(5)).value()};
  std::vector<Pose> poses(2 * 200, at(3));
  EXPECT_EQ(scene.collide_configurations(ids, std::span(poses).first(3)).error().code, Code::bad_option);
  EXPECT_EQ(scene.collide_configurations(std::array{ids[0], ids[0]}, poses).error().message.substr(0, 7), "ids[1]:");
  EXPECT_TRUE(scene.collide_configurations(ids, {})->touches.empty());
  EXPECT_TRUE(scene.collide_configurations({}, {})->touches.empty());
  EXPECT_FALSE(scene.first_touching(ids, {})->has_value());
  // The one configuration that touches is found wherever it is.
  for (std::size_t n : {1, 2, 3, 8, 64, 65, 200})
    for (std::size_t i = 0; i < n; i += n / 8 + 1) {
      std::vector<Pose> path(2 * n, at(3));
      for (std::size_t k = 0; k < n; ++k) path[2 * k + 1] = at(k == i ? 4 : 9);
      EXPECT_EQ(scene.first_touching(ids, path).value(), i) << n;
    }
  poses[2 * 177 + 1].t[1] = std::numeric_limits<double>::quiet_NaN();
  poses[2 * 130].t[0] = 0x1p301;
  const auto found = scene.collide_configurations(ids, poses);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Code::out_of_range);
  EXPECT_EQ(found.error().message.substr(0, 18), "configuration 130:");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(scene.collide_configurations(ids, poses, {.stop = stop.get_token()}).error().code, Code::cancelled);
  EXPECT_EQ(scene.collide_configurations(ids, poses, {.threads = -1}).error().code, Code::bad_option);
}

}  // namespace
}  // namespace impinge
