// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "impinge/scene.hpp"
#include "scenes/random.hpp"
#include "scenes/shapes.hpp"
#include "tests/broad/bodies.hpp"
#include "tests/core/support.hpp"
#include "tests/hierarchy/wide_trees.hpp"
#include "tests/memory/own_allocator.hpp"

namespace impinge {
namespace {

using test::countdown;

/// Lets each allocation in turn fail, the first, the second and so on, until the call succeeds. After each failure the
/// same mesh must still give the right answer, with the same memory: a workspace, or what the thread keeps.
void fail_each_allocation(const char* backend, int threads) {
  const scenes::MeshData ball = scenes::uv_sphere(10, 12);
  Pose pose;
  pose.t = {0.7, 0.2, 0.1};
  const Options options{.threads = threads, .backend = backend};
  const Mesh whole = test::mesh_of(ball);
  const auto expected = test::listed(*collide(whole, {}, whole, pose, options));
  ASSERT_FALSE(expected.empty());

  int failures = 0;
  for (long allowed = 0;; ++allowed) {
    const Mesh mesh = test::mesh_of(ball);
    Workspace own;
    Workspace* const workspace = allowed % 2 == 0 ? &own : nullptr;
    countdown = allowed;
    const auto starved = collide(mesh, {}, mesh, pose, options, workspace);
    const bool has_failed = countdown.exchange(-1) < 0;
    if (!starved) {
      ++failures;
      EXPECT_EQ(starved.error().code, Code::out_of_memory);
    } else {
      ASSERT_EQ(test::listed(*starved), expected);
    }
    const auto again = collide(mesh, {}, mesh, pose, options, workspace);
    ASSERT_TRUE(again) << again.error().message;
    ASSERT_EQ(test::listed(*again), expected) << "after the failure of allocation " << allowed;
    if (workspace != nullptr && starved && !has_failed) break;
  }
  EXPECT_GT(failures, 10);
}

TEST(OutOfMemory, IsAnErrorThatHarmsNoMeshOnOneThread) { fail_each_allocation("simd", 1); }
TEST(OutOfMemory, IsAnErrorThatHarmsNoMeshOnTwoThreads) { fail_each_allocation("simd", 2); }
TEST(OutOfMemory, IsAnErrorThatHarmsNoMeshOnOneThreadOfThePlainBackend) { fail_each_allocation("paper", 1); }
TEST(OutOfMemory, IsAnErrorThatHarmsNoMeshOnTwoThreadsOfThePlainBackend) { fail_each_allocation("paper", 2); }

TEST(OutOfMemory, IsAnErrorOfBuildTreeThatMayBeAskedForAgain) {
  const scenes::MeshData ball = scenes::uv_sphere(20, 20);
  Pose pose;
  pose.t = {0.7, 0.2, 0.1};
  const Mesh whole = test::mesh_of(ball);
  const auto expected = test::listed(*collide(whole, {}, whole, pose));
  for (const int threads : {1, 2}) {
    int failures = 0;
    for (long allowed = 0;; ++allowed) {
      const Mesh mesh = test::mesh_of(ball);
      countdown = allowed;
      const auto starved = mesh.build_tree(threads);
      const bool has_failed = countdown.exchange(-1) < 0;
      if (!starved) {
        ++failures;
        ASSERT_EQ(starved.error().code, Code::out_of_memory);
      }
      ASSERT_TRUE(mesh.build_tree(threads));
      ASSERT_EQ(test::listed(*collide(mesh, {}, mesh, pose, {.threads = 1})), expected);
      if (starved && !has_failed) break;
    }
    EXPECT_GT(failures, 3);
  }
}

/// A frame of a scene: what moves, the update, the query.
TEST(OutOfMemory, IsAnErrorThatHarmsNoScene) {
  const Mesh ball = test::mesh_of(scenes::uv_sphere(6, 7));
  const auto make = [&] {
    Scene scene;
    for (int i = 0; i < 12; ++i) EXPECT_TRUE(scene.add(ball, {.t = {0.9 * (i % 3), 0.8 * (i / 3), 0.3 * (i % 2)}}));
    return scene;
  };
  const auto expected = test::listed(*make().collide());
  ASSERT_FALSE(expected.empty());
  int failures = 0;
  for (long allowed = 0;; ++allowed) {
    Scene scene = make();
    Workspace workspace;
    countdown = allowed;
    const auto updated = scene.update();
    const auto found = scene.collide({.threads = 1}, &workspace);
    const bool has_failed = countdown.exchange(-1) < 0;
    failures += !updated || !found ? 1 : 0;
    if (!updated) {
      ASSERT_EQ(updated.error().code, Code::out_of_memory);
    }
    if (found) {
      ASSERT_EQ(test::listed(*found), expected);
    } else {
      ASSERT_EQ(found.error().code, Code::out_of_memory);
    }
    ASSERT_EQ(test::listed(*scene.collide({.threads = 1}, &workspace)), expected);
    ASSERT_TRUE(scene.update());
    ASSERT_EQ(test::listed(*scene.collide({.threads = 1}, &workspace)), expected);
    if (!has_failed) break;
  }
  EXPECT_GT(failures, 10);
}

TEST(OutOfMemory, IsAnErrorOfMeshCreate) {
  const scenes::MeshData ball = scenes::uv_sphere(4, 5);
  for (long allowed = 0;; ++allowed) {
    countdown = allowed;
    const auto mesh = Mesh::create(ball.xyz, ball.triangles);
    const bool has_failed = countdown.exchange(-1) < 0;
    if (!has_failed) break;
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, Code::out_of_memory);
  }
}

TEST(OutOfMemory, IsAnErrorOfDeformedAndSelfCollideThatHarmsNoMesh) {
  const scenes::MeshData ball = scenes::uv_sphere(20, 20);
  std::vector<double> flat = ball.xyz;
  for (std::size_t i = 2; i < flat.size(); i += 3) flat[i] *= 0x1p-60;
  const Mesh mesh = test::mesh_of(ball);
  ASSERT_TRUE(mesh.build_tree(1));  // to be refitted
  const auto expected = test::listed(*self_collide(test::mesh_of({flat, ball.triangles})));
  int failures = 0;
  for (long allowed = 0;; ++allowed) {
    countdown = allowed;
    const auto deformed = mesh.deformed(flat);
    const auto found = deformed ? self_collide(*deformed, {}, {.threads = 1}) : deformed.error();
    const bool has_failed = countdown.exchange(-1) < 0;
    if (!found) {
      ++failures;
      ASSERT_EQ(found.error().code, Code::out_of_memory);
    } else {
      ASSERT_EQ(test::listed(*found), expected);
    }
    ASSERT_TRUE(self_collide(mesh)->triangles.empty());
    if (!has_failed) break;
  }
  EXPECT_GT(failures, 5);
}

/// Every node and leaf is tried with one allocation more each time, until it is made: what is there stays, and in the
/// end it is the tree that it would have been.
TEST(WideTree, IsWholeInTheEndHoweverOftenMemoryRanOut) {
  scenes::MeshData numbers = scenes::torus_knot_of(3162);
  numbers.add_triangle({1e8, 0, 0, 1e8, 0, 0, 1e8, 0, 0});  // so that ranges get bases of their own
  const Mesh mesh = test::mesh_of(numbers);
  hierarchy::WideTree plain(test::numbers_of(mesh), 16);
  const std::string expected = test::bytes_of(plain);
  int failures = 0;
  for (long allowed = 0; allowed < 40; ++allowed) {
    hierarchy::WideTree tree(test::numbers_of(mesh), 16);
    hierarchy::MadeNodes made;
    std::vector<hierarchy::TreeRef> open;
    // One after the other, each tried with as few allocations as it takes.
    const auto insist = [&](const auto& make) {
      for (long granted = allowed % 5;; ++granted) {
        countdown = granted;
        try {
          const std::uint64_t before = made.nodes;
          const hierarchy::TreeRef ref = make();
          countdown = -1;
          EXPECT_EQ(made.nodes, before + 1);
          return ref;
        } catch (const std::bad_alloc&) {
          countdown = -1;
          ++failures;
        }
      }
    };
    open.push_back(insist([&] { return tree.root(made); }));
    while (!open.empty()) {
      const hierarchy::TreeRef next = open.back();
      open.pop_back();
      if (next.is_leaf()) continue;
      for (std::uint32_t lane = 0; lane < next.node().size; ++lane)
        open.push_back(insist([&] { return tree.child(next.node(), static_cast<int>(lane), made); }));
    }
    ASSERT_TRUE(test::bytes_of(tree) == expected);
  }
  EXPECT_GT(failures, 500);
}

using test::allocations;
using test::live_bytes;

using scene::PlacedObject;
using test::box_at;

/// Each of a crowd on a circle of its own.
std::vector<PlacedObject> circling(int n, int frame) {
  scenes::Random random(1);
  const double side = 1.5 * std::cbrt(n);
  std::vector<PlacedObject> objects;
  for (int i = 0; i < n; ++i) {
    const Vec3 middle{random.uniform(-side, side), random.uniform(-side, side), random.uniform(-side, side)};
    const double angle = random.uniform(0, 6.28) + 6.283185307179586 * frame / 100;
    objects.push_back(box_at(middle + Vec3{std::cos(angle), std::sin(angle), 0}, {1, 1, 1}));
  }
  return objects;
}

TEST(NearPairs, NeedNoMemoryInASteadyFrame) {
  constexpr int n = 1000;
  broad::NearPairs near_pairs;
  broad::ObjectPairs pairs;
  broad::NearPairs::Scratch scratch;
  near_pairs.reserve(n);
  long before = 0;
  std::uint64_t tests_before = 0;
  for (int frame = 0; frame < 600; ++frame) {
    const std::vector<PlacedObject> objects = circling(n, frame);
    if (frame == 300) tests_before = near_pairs.box_tests();
    before = allocations;
    for (std::uint32_t i = 0; i < n; ++i) near_pairs.place(i, objects[i]);
    near_pairs.update();
    near_pairs.find({objects}, pairs, scratch);
    if (frame >= 300) {
      ASSERT_EQ(allocations, before) << "in frame " << frame;
    }
    ASSERT_FALSE(pairs.empty());
  }
  EXPECT_GT(near_pairs.box_tests(), tests_before);  // there was something to update
}

/// The first `n` of a crowd; those beyond 200 are far from the others.
std::vector<PlacedObject> arriving(std::size_t n) {
  std::vector<PlacedObject> objects = circling(300, 0);
  for (std::size_t i = 200; i < 300; ++i) {
    Box& box = objects[i].box;
    const Vec3 far{100 + 3.0 * static_cast<double>(i), 100, 0};
    box = {box.lo + far, box.hi + far};
    objects[i].sphere.center = objects[i].sphere.center + far;
  }
  objects.resize(n);
  return objects;
}

/// Lets each allocation of the first update in turn fail, or of one after so many frames. The next update must be
/// right.
TEST(NearPairs, AreRightAfterMemoryRanOut) {
  constexpr int n = 300;
  int failures = 0;
  const std::vector<PlacedObject> some = arriving(200), more = arriving(n);
  for (const int frames : {-1, 0, 1, 3, 60})  // far arrivals; from nothing; few have left their rooms, many, all
    for (long allowed = 0;; ++allowed) {
      broad::NearPairs near_pairs;
      near_pairs.reserve(n);
      if (frames != 0) test::update(near_pairs, frames < 0 ? some : circling(n, 0));
      std::vector<PlacedObject> objects = frames < 0 ? more : circling(n, frames);
      for (std::size_t i = 0; i < 10; ++i) objects[20 * i] = {};
      for (std::uint32_t i = 0; i < n; ++i) near_pairs.place(i, objects[i]);
      countdown = allowed;
      bool is_starved = false;
      try {
        near_pairs.update();
      } catch (const std::bad_alloc&) {
        is_starved = true;
      }
      countdown = -1;
      if (!is_starved) break;
      ++failures;
      EXPECT_FALSE(near_pairs.is_current());
      if (allowed % 2 == 0) {  // with and without further motion
        objects = circling(n, frames + 1);
        for (std::uint32_t i = 0; i < n; ++i) near_pairs.place(i, objects[i]);
      }
      near_pairs.update();
      ASSERT_TRUE(test::pairs_of(near_pairs, {objects}) == test::all_pairs({objects}))
          << "after the failure of allocation " << allowed << " after " << frames << " frames";
    }
  EXPECT_GT(failures, 20);
}

/// Of objects that come, move, ignore each other and go, nothing stays.
TEST(Scene, HoldsNoMemoryOfObjectsThatAreGone) {
  const Mesh mesh = test::mesh_of(scenes::cube());
  Scene scene;
  test::Seeded seeded(2);
  std::vector<ObjectId> ids;
  long settled = 0;
  const auto somewhere = [&] {
    Pose pose;
    for (double& t : pose.t) t = seeded.random.uniform(0, 6);
    return pose;
  };
  for (int round = 0; round < 20000; ++round) {
    ids.push_back(scene.add(mesh, somewhere()).value());
    if (ids.size() > 1) {
      ASSERT_TRUE(scene.ignore(ids.back(), ids[seeded.random.bits() % (ids.size() - 1)]));
    }
    if (ids.size() > 100) {
      const std::size_t gone = seeded.random.bits() % ids.size();
      ASSERT_TRUE(scene.remove(ids[gone]));
      ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(gone));
    }
    if (round % 3 == 0) {
      ASSERT_TRUE(scene.update());
    }
    if (round == 5000) settled = live_bytes;
  }
  EXPECT_LT(live_bytes, settled + settled / 4);
  for (const ObjectId id : ids) ASSERT_TRUE(scene.remove(id));
  ASSERT_TRUE(scene.update());
  EXPECT_EQ(scene.size(), 0u);
}

}  // namespace
}  // namespace impinge
