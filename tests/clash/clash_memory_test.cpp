// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What find_clashes keeps for its next call changes nothing: every answer is that of a scene made anew of meshes made
// anew, of which nothing is known.
#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "impinge/clash.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/clash/same_clashes.hpp"
#include "tests/core/support.hpp"
#include "tests/pipeline/crowd.hpp"

namespace impinge {
namespace {

/// A scene that changes, and what it is at any time.
class Stage {
 public:
  explicit Stage(scenes::PlacedScene start) : now_(std::move(start)) {
    const std::vector<Mesh> meshes = test::meshes_of(now_);
    for (const auto& object : now_.objects)
      ids_.push_back(scene_.add(meshes[object.mesh], object.pose, object.group).value());
    start_ = now_;
  }

  void move(std::uint32_t object, const Pose& pose) {
    now_.objects[object].pose = pose;
    ASSERT_TRUE(scene_.set_pose(ids_[object], pose));
  }
  void move_back(std::uint32_t object) { move(object, start_.objects[object].pose); }
  void reshape(std::uint32_t object, scenes::MeshData mesh) {
    ASSERT_TRUE(scene_.set_mesh(ids_[object], test::mesh_of(mesh), now_.objects[object].pose));
    now_.objects[object].mesh = static_cast<std::uint32_t>(now_.meshes.size());
    now_.meshes.push_back(std::move(mesh));
  }
  /// At the same place in the list, since that was freed last.
  void add_again(std::uint32_t object) {
    const auto& [mesh, pose, group] = now_.objects[object];
    ASSERT_TRUE(scene_.remove(ids_[object]));
    ids_[object] = scene_.add(test::mesh_of(now_.meshes[mesh]), pose, group).value();
    ASSERT_EQ(ids_[object].index, object);
    std::erase_if(ignored_, [&](const auto& pair) { return pair.first == object || pair.second == object; });
  }
  void toggle_ignored(std::uint32_t a, std::uint32_t b) {
    if (ignored_.erase({a, b}) > 0) {
      ASSERT_TRUE(scene_.unignore(ids_[a], ids_[b]));
    } else {
      ASSERT_TRUE(scene_.ignore(ids_[a], ids_[b]));
      ignored_.insert({a, b});
    }
  }

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(ids_.size()); }
  [[nodiscard]] const Pose& pose(std::uint32_t object) const { return now_.objects[object].pose; }
  [[nodiscard]] Scene anew() const {
    Scene scene;
    std::vector<ObjectId> ids;
    const std::vector<Mesh> meshes = test::meshes_of(now_);
    for (const auto& object : now_.objects)
      ids.push_back(scene.add(meshes[object.mesh], object.pose, object.group).value());
    for (const auto& [a, b] : ignored_) EXPECT_TRUE(scene.ignore(ids[a], ids[b]));
    return scene;
  }

 private:
  scenes::PlacedScene now_, start_;
  Scene scene_;
  std::vector<ObjectId> ids_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> ignored_;
};

/// Flush boxes, surfaces of all kinds, a part with a shell that is no boundary, and one of which each rounding counts.
scenes::PlacedScene parts(std::uint64_t seed) {
  scenes::PlacedScene scene = test::crowd(seed);
  const auto add = [&](scenes::MeshData mesh, const Pose& pose) {
    scene.objects.push_back({.mesh = static_cast<std::uint32_t>(scene.meshes.size()), .pose = pose});
    scene.meshes.push_back(std::move(mesh));
  };
  add(scenes::joined(scenes::box({0, 0, 0}, {1, 1, 1}), scenes::box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})),
      {.t = {0.5, 0.5, 0.5}});
  add(scenes::box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}, 2), {});
  return scene;
}

std::uint32_t pick(scenes::Random& random, std::uint32_t n) {
  return static_cast<std::uint32_t>(random.integer(0, static_cast<int>(n) - 1));
}

TEST(ClashMemory, ChangesNoAnswerWhateverMoves) {
  test::Seeded seeded(1);
  scenes::Random& random = seeded.random;
  Stage stage(parts(1));
  ClashMemory memory;
  ClashOptions options{.clearance = 0.01};
  std::size_t known = 0;
  for (int frame = 0; frame < 16; ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    switch (frame % 8) {
      case 0:
        options.depth_precision = frame == 0 ? 0.05 : 0.01;  // all stand still, and something else is asked
        break;
      case 1:
      case 5:
        for (int i = 0; i < 3; ++i) stage.move(pick(random, stage.size()), scenes::random_motion(random, 1));
        break;
      case 2:
        for (std::uint32_t i = 0; i < stage.size(); i += 2) stage.move_back(i);
        break;
      case 3:
        stage.reshape(pick(random, stage.size()), scenes::box({0, 0, 0}, {1.5, 0.5, 1}, 2));
        break;
      case 4:
        options.regions = frame == 4;
        options.volumes = frame == 12;
        stage.add_again(pick(random, stage.size()));
        break;
      case 6:
        for (std::uint32_t i = 0; i < 4; ++i) stage.toggle_ignored(i, i + 1);
        break;
      default:
        options.tolerance = frame < 8 ? std::optional(0.0) : std::nullopt;
    }
    const auto expected = find_clashes(stage.anew(), options);
    const auto found = find_clashes(stage.scene(), options, &memory);
    ASSERT_TRUE(expected && found);
    EXPECT_GT(expected->pairs.size(), 10u);
    test::expect_same(*expected, *found);
    known += memory.known_pairs();
  }
  EXPECT_GT(known, 50u);
}

TEST(ClashMemory, LooksOnlyAtWhatMoved) {
  Stage stage(scenes::flush_boxes(4, 4, 4));
  ClashMemory memory;
  const Clashes first = find_clashes(stage.scene(), {}, &memory).value();
  EXPECT_EQ(memory.known_pairs(), 0u);
  test::expect_same(first, find_clashes(stage.scene(), {}, &memory).value());
  EXPECT_EQ(memory.known_pairs(), first.candidates);
  // The one in the corner has seven neighbours.
  const Pose pose = stage.pose(0);
  stage.move(0, {.t = {100, 0, 0}});
  const Clashes without = find_clashes(stage.scene(), {}, &memory).value();
  EXPECT_EQ(without.candidates, first.candidates - 7);
  EXPECT_EQ(memory.known_pairs(), first.candidates - 7);
  stage.move(0, pose);
  test::expect_same(first, find_clashes(stage.scene(), {}, &memory).value());
  EXPECT_EQ(memory.known_pairs(), first.candidates - 7);
}

TEST(ClashMemory, KnowsOtherTermsFromThoseBefore) {
  const Stage stage(parts(4));
  ClashMemory memory;
  for (int round = 0; round < 6; ++round) {
    SCOPED_TRACE(round);
    ClashOptions options{.clearance = 0.05};
    options.terms = [&](std::uint32_t a, std::uint32_t b, std::vector<ClashTerms>& terms) {
      if ((a + b) % 3 == 0) terms.push_back({.tolerance = 0.01, .test = 7});
      if ((a + b) % 2 == 0 && round % 3 != 0) terms.push_back({.clearance = round < 3 ? 0.05 : 0.02, .test = 8});
    };
    test::expect_same(find_clashes(stage.anew(), options).value(),
                      find_clashes(stage.scene(), options, &memory).value());
  }
  // What was known on terms that now reach too far is an error, as it is to whoever knows nothing.
  ClashOptions narrow{.clearance = 0.001};
  narrow.terms = [](std::uint32_t, std::uint32_t, std::vector<ClashTerms>& terms) {
    terms.push_back({.clearance = 0.02});
  };
  ClashOptions wide = narrow;
  wide.clearance = 0.05;
  test::expect_same(find_clashes(stage.anew(), wide).value(), find_clashes(stage.scene(), wide, &memory).value());
  const auto refused = find_clashes(stage.scene(), narrow, &memory);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Code::bad_option);
  test::expect_same(find_clashes(stage.anew(), wide).value(), find_clashes(stage.scene(), wide, &memory).value());
}

TEST(ClashMemory, ServesAnotherSceneAfterOneThatIsGoneOrWasStopped) {
  ClashMemory memory;
  for (const std::uint64_t seed : {5, 6, 5}) {
    const Stage stage(parts(seed));
    std::stop_source source;
    source.request_stop();
    const auto stopped = find_clashes(stage.scene(), {.stop = source.get_token()}, &memory);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, Code::cancelled);
    test::expect_same(find_clashes(stage.anew()).value(), find_clashes(stage.scene(), {}, &memory).value());
  }
  const Scene none;
  EXPECT_TRUE(find_clashes(none, {}, &memory)->pairs.empty());
}

TEST(Scene, AShapeThatChangesKeepsItsObject) {
  Scene scene;
  const Mesh cube = test::mesh_of(scenes::cube());
  const ObjectId a = scene.add(cube).value(), b = scene.add(cube, {.t = {5, 0, 0}}).value(),
                 c = scene.add(cube, {.t = {0, 0.5, 0}}, 3).value(), d = scene.add(cube, {.t = {9, 0, 0}}, 3).value();
  ASSERT_TRUE(scene.ignore(a, c));
  EXPECT_TRUE(scene.collide()->objects.empty());
  ASSERT_TRUE(scene.set_mesh(b, test::mesh_of(scenes::box({-5, 0, 0}, {1, 1, 1})), {.t = {5, 0, 0}}));
  using Pairs = std::vector<std::array<std::uint32_t, 2>>;
  EXPECT_EQ(scene.collide()->objects, Pairs({{a.index, b.index}, {b.index, c.index}}));
  // The group and the pair that is left out go with the object.
  ASSERT_TRUE(scene.set_mesh(d, test::mesh_of(scenes::box({-9, 0, 0}, {0, 1, 1})), {.t = {9, 0, 0}}));
  EXPECT_EQ(scene.collide()->objects,
            Pairs({{a.index, b.index}, {a.index, d.index}, {b.index, c.index}, {b.index, d.index}}));
  Pose skewed;
  skewed.R[1] = 0.5;
  EXPECT_EQ(scene.set_mesh(b, cube, skewed).error().code, Code::bad_pose);
  EXPECT_EQ(scene.collide()->objects.size(), 4u);
  ASSERT_TRUE(scene.remove(b));
  EXPECT_EQ(scene.set_mesh(b, cube).error().code, Code::unknown_id);
}

}  // namespace
}  // namespace impinge
