// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "impinge/measures.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
#include "tests/memory/own_allocator.hpp"

namespace impinge {
namespace {

using test::allocations;

/// Runs frame(0) to frame(n - 1) until the trees are made and the memory is large enough, and fails if a later round
/// allocates.
template <class Frame>
void expect_steady(int n, const Frame& frame) {
  for (int round = 0; round < 4; ++round)
    for (int i = 0; i < n; ++i) frame(i);
  const std::uint64_t before = allocations;
  for (int i = 0; i < n; ++i) frame(i);
  EXPECT_EQ(allocations - before, 0u);
}

std::vector<Pose> poses_along(const Pose& from, int n, double step) {
  std::vector<Pose> poses(static_cast<std::size_t>(n), from);
  for (int i = 0; i < n; ++i) poses[static_cast<std::size_t>(i)].t[0] += step * i;
  return poses;
}

/// All options that change which code runs.
std::vector<Options> all_options() {
  return {{.threads = 1, .backend = "simd"},
          {.find = Options::Find::first, .threads = 1, .backend = "simd"},
          {.kinds = kCrossing, .threads = 1}};
}

TEST(SteadySeries, OfPairsAllocatesNothing) {
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968)), ball = test::mesh_of(scenes::uv_sphere(24, 24));
  const std::vector<Pose> poses = poses_along({.t = {-2, 0.3, 0.1}}, 40, 0.1);
  std::vector<Options> options_of_pairs = all_options();
  options_of_pairs.push_back({.find = Options::Find::first});  // ends before another thread would be woken
  for (const Options& options : options_of_pairs) {
    Workspace workspace;
    std::size_t contacts = 0;
    expect_steady(40, [&](int i) {
      Contacts found = collide(knot, {}, ball, poses[static_cast<std::size_t>(i)], options, &workspace).value();
      contacts += found.triangles.size();
      workspace.recycle(std::move(found));
    });
    EXPECT_GT(contacts, 100u);
  }
}

/// Where everything touches and the exact stage has all the work.
TEST(SteadySeries, OfTouchingPairsAllocatesNothing) {
  scenes::Random random(1);
  const Mesh plane = test::mesh_of(scenes::flat_grid(12, 12)), cube = test::mesh_of(scenes::cube());
  const Mesh soup = test::mesh_of(scenes::degenerate_soup(random, 60, 3));
  const Pose turned = scenes::random_motion(random, 10);
  Workspace workspace;
  expect_steady(20, [&](int i) {
    Pose moved = turned;
    moved.t[0] += 0.25 * i;
    Contacts found = collide(plane, turned, plane, moved, {.threads = 1}, &workspace).value();
    workspace.recycle(std::move(found));
    found = collide(cube, {}, soup, {.t = {0.25 * i, 0, 0}}, {.threads = 1}, &workspace).value();
    workspace.recycle(std::move(found));
  });
}

/// An arm of five links among balls: jumps, as a planner makes them.
class Robot {
 public:
  Robot() {
    scenes::Random random(3);
    const Mesh link = test::mesh_of(scenes::pipe(12, 6, 0.3, 1, true)), ball = test::mesh_of(scenes::uv_sphere(12, 12));
    for (int i = 0; i < 40; ++i)
      EXPECT_TRUE(scene.add(ball, {.t = {random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)}}, 1));
    for (int i = 0; i < kLinks; ++i) links.push_back(scene.add(link).value());
    for (int i = 0; i < kConfigurations * kLinks; ++i) poses.push_back(scenes::random_motion(random, 6));
    EXPECT_TRUE(scene.update());
  }
  [[nodiscard]] std::span<const Pose> configuration(int i) const {
    return std::span(poses).subspan(static_cast<std::size_t>(i * kLinks), kLinks);
  }
  /// The same configurations several times over.
  [[nodiscard]] std::vector<Pose> repeated(int times) const {
    std::vector<Pose> all;
    for (int i = 0; i < times; ++i) all.insert(all.end(), poses.begin(), poses.end());
    return all;
  }

  static constexpr int kLinks = 5, kConfigurations = 60;
  Scene scene;
  std::vector<ObjectId> links;
  std::vector<Pose> poses;
};

/// A batch allocates for the call and not for a configuration: as often for many as for few of the same.
TEST(SteadySeries, OfConfigurationsAllocatesNothingForEach) {
  const Robot robot;
  const auto expect_same = [](const std::vector<Pose>& few, const std::vector<Pose>& many, const auto& ask) {
    const auto allocated = [&](const std::vector<Pose>& poses) {
      const std::uint64_t before = allocations;
      ask(poses);
      return allocations - before;
    };
    allocated(few);  // makes the trees
    const std::uint64_t of_few = allocated(few);
    EXPECT_EQ(allocated(many), of_few);
  };
  std::size_t touching = 0;
  const auto few = robot.repeated(1), many = robot.repeated(9);
  for (const bool witnesses : {false, true})
    expect_same(few, many, [&](const std::vector<Pose>& poses) {
      const auto found = robot.scene.collide_configurations(robot.links, poses, {.witnesses = witnesses, .threads = 1});
      for (const std::uint8_t touches : found->touches) touching += touches;
    });
  EXPECT_GT(touching, 100u);
  expect_same(few, many, [&](const std::vector<Pose>& poses) {
    EXPECT_TRUE(robot.scene.distance_configurations(robot.links, poses, {.threads = 1}));
  });
}

/// Of one object with the others, and of a mesh that is none of them.
TEST(SteadySeries, OfOneObjectAllocatesNothing) {
  Robot robot;
  const Mesh guest = test::mesh_of(scenes::cube());
  Workspace workspace;
  std::size_t contacts = 0;
  for (const Options& options : all_options())
    expect_steady(Robot::kConfigurations, [&](int i) {
      EXPECT_TRUE(robot.scene.set_poses(robot.links, robot.configuration(i)));
      EXPECT_TRUE(robot.scene.update(1));
      for (const bool is_guest : {false, true}) {
        const Pose& pose = robot.configuration(i)[0];
        Contacts found = (is_guest ? robot.scene.collide_with(guest, pose, options, &workspace)
                                   : robot.scene.collide_with(robot.links[0], options, &workspace))
                             .value();
        contacts += found.triangles.size();
        workspace.recycle(std::move(found));
      }
    });
  EXPECT_GT(contacts, 100u);
}

TEST(SteadySeries, OfTouchesAnyAllocatesNothing) {
  Robot robot;
  Workspace workspace;
  int touching = 0;
  expect_steady(Robot::kConfigurations, [&](int i) {
    EXPECT_TRUE(robot.scene.set_poses(robot.links, robot.configuration(i)));
    EXPECT_TRUE(robot.scene.update(1));
    touching += robot.scene.touches_any({.threads = 1}, &workspace).value() ? 1 : 0;
  });
  EXPECT_GT(touching, 10);
}

TEST(SteadySeries, OfTouchesAllocatesNothing) {
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968)), cube = test::mesh_of(scenes::cube());
  const std::vector<Pose> poses = poses_along({.t = {-2, 0.3, 0.1}}, 60, 0.1);
  int touching = 0;
  expect_steady(
      60, [&](int i) { touching += touches(cube, {}, knot, poses[static_cast<std::size_t>(i)]).value() ? 1 : 0; });
  EXPECT_GT(touching, 5);
}

TEST(SteadySeries, OfPosesAllocatesNothing) {
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968)), cube = test::mesh_of(scenes::cube());
  const std::vector<Pose> poses = poses_along({.t = {-2, 0.3, 0.1}}, 60, 0.1);
  Workspace workspace;
  expect_steady(5, [&](int i) {
    const std::span<const Pose> some(poses.data() + i, 50);
    Contacts found = collide_poses(cube, {poses.data(), 1}, knot, some, {.threads = 1}, &workspace).value();
    workspace.recycle(std::move(found));
  });
}

/// Bodies that move a little each frame, as a simulation has them.
TEST(SteadySeries, OfScenesAllocatesNothing) {
  scenes::Random random(2);
  const scenes::PlacedScene placed = scenes::scattered(random, scenes::torus_knot_of(968), 12, 8);
  for (const Options& options : all_options()) {
    Scene scene;
    const Mesh mesh = test::mesh_of(placed.meshes[0]);
    std::vector<ObjectId> ids;
    for (const auto& object : placed.objects) ids.push_back(scene.add(mesh, object.pose).value());
    Workspace workspace;
    ContactManifolds manifolds;
    std::size_t contacts = 0, regions = 0;
    const bool is_partial = options.find == Options::Find::first || options.kinds != kAllKinds;
    expect_steady(20, [&](int i) {
      for (std::size_t k = 0; k < ids.size(); ++k) {
        Pose pose = placed.objects[k].pose;
        pose.t[k % 3] += 0.02 * i;
        ASSERT_TRUE(scene.set_pose(ids[k], pose));
      }
      ASSERT_TRUE(scene.update());
      Contacts found = scene.collide(options, &workspace).value();
      contacts += found.triangles.size();
      if (!found.partial) regions += manifolds.update(scene, found).value().size();
      workspace.recycle(std::move(found));
    });
    EXPECT_GT(contacts, 100u);
    EXPECT_TRUE(regions > 100 || is_partial);
  }
}

/// What may not fail for want of memory has its room in a copy too.
TEST(SteadySeries, OfACopysObjectsAllocatesNothing) {
  Scene scene;
  const Mesh cube = test::mesh_of(scenes::cube());
  std::vector<ObjectId> ids;
  for (int i = 0; i < 100; ++i) ids.push_back(scene.add(cube, {.t = {2.0 * i, 0, 0}}).value());
  ASSERT_TRUE(scene.update());
  Scene copy = scene;
  const std::uint64_t before = allocations;
  for (const ObjectId id : ids) {
    ASSERT_TRUE(copy.set_pose(id, {.t = {0, 5, 0}}));
    ASSERT_TRUE(copy.remove(id));
  }
  EXPECT_EQ(allocations - before, 0u);
}

/// With a workspace of one's own, and with the thread's.
TEST(SteadySeries, OfDistancesAllocatesNothing) {
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968)), ball = test::mesh_of(scenes::uv_sphere(24, 24));
  const std::vector<Pose> poses = poses_along({.t = {-4, 0.3, 0.1}}, 40, 0.2);
  Workspace own;
  for (Workspace* const workspace : {&own, static_cast<Workspace*>(nullptr)}) {
    int touching = 0, closer = 0;
    expect_steady(40, [&](int i) {
      const Pose& pose = poses[static_cast<std::size_t>(i)];
      touching += distance(knot, {}, ball, pose, {.threads = 1}, workspace).value().distance == 0;
      closer += closer_than(knot, {}, ball, pose, 0.5, {.threads = 1}, workspace).value();
    });
    EXPECT_GT(touching, 0);
    EXPECT_GT(closer, touching);
  }
}

/// The count counts.
TEST(SteadySeries, WithoutRecyclingAllocates) {
  const Mesh cube = test::mesh_of(scenes::cube());
  Workspace workspace;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(collide(cube, {}, cube, {}, {.threads = 1}, &workspace));
  const std::uint64_t before = allocations;
  ASSERT_TRUE(collide(cube, {}, cube, {}, {.threads = 1}, &workspace));
  EXPECT_GT(allocations - before, 0u);
}

}  // namespace
}  // namespace impinge
