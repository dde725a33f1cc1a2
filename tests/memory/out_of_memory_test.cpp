// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
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

}  // namespace
}  // namespace impinge
