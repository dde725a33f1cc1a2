// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace {

/// Allocations until the one that fails; negative: none does.
std::atomic<long> countdown{-1};

bool fails() { return countdown.load() >= 0 && countdown.fetch_sub(1) == 0; }

}  // namespace

// Not inlined: the compiler would otherwise see free() meet new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (fails()) throw std::bad_alloc();
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace impinge {
namespace {

/// Lets each allocation in turn fail, the first, the second and so on, until the call succeeds. After each failure the
/// same mesh must still give the right answer.
void fail_each_allocation(int threads) {
  const scenes::MeshData ball = scenes::uv_sphere(10, 12);
  Pose pose;
  pose.t = {0.7, 0.2, 0.1};
  const Options options{.threads = threads};
  const Mesh whole = test::mesh_of(ball);
  const auto expected = test::listed(*collide(whole, {}, whole, pose, options));
  ASSERT_FALSE(expected.empty());

  int failures = 0;
  for (long allowed = 0;; ++allowed) {
    const Mesh mesh = test::mesh_of(ball);
    countdown = allowed;
    const auto starved = collide(mesh, {}, mesh, pose, options);
    const bool has_failed = countdown.exchange(-1) < 0;
    if (!starved) {
      ++failures;
      EXPECT_EQ(starved.error().code, Code::out_of_memory);
    } else {
      ASSERT_EQ(test::listed(*starved), expected);
    }
    const auto again = collide(mesh, {}, mesh, pose, options);
    ASSERT_TRUE(again) << again.error().message;
    ASSERT_EQ(test::listed(*again), expected) << "after the failure of allocation " << allowed;
    if (starved && !has_failed) break;
  }
  EXPECT_GT(failures, 20);
}

TEST(OutOfMemory, IsAnErrorThatHarmsNoMeshOnOneThread) { fail_each_allocation(1); }
TEST(OutOfMemory, IsAnErrorThatHarmsNoMeshOnTwoThreads) { fail_each_allocation(2); }

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

}  // namespace
}  // namespace impinge
