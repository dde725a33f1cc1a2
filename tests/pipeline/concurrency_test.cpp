// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cfenv>
#include <numeric>
#include <thread>

#include "schedule/parallel.hpp"
#include "tests/core/support.hpp"
#include "tests/pipeline/crowd.hpp"

/// Many threads at once on meshes and scenes that they share, while the trees grow under them.
namespace impinge {
namespace {

struct Question {
  Pose a, b;
};

std::vector<Question> questions(std::uint64_t seed, int n) {
  scenes::Random random(seed);
  std::vector<Question> list;
  for (int i = 0; i < n; ++i) list.push_back({scenes::random_motion(random, 0.5), scenes::random_motion(random, 1.5)});
  return list;
}

/// Runs body(0) .. body(n - 1) on a thread each, all starting together.
template <class Body>
void on_threads(int n, const Body& body) {
  std::atomic<bool> go{false};
  std::vector<std::thread> threads;
  for (int i = 0; i < n; ++i)
    threads.emplace_back([&, i] {
      go.wait(false);
      body(i);
    });
  go = true;
  go.notify_all();
  for (std::thread& thread : threads) thread.join();
}

TEST(Answer, IsTheSameForEveryThreadCount) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 16);
  const scenes::PlacedScene placed = test::crowd(1);
  const Contacts expected = test::scene_of(placed).collide({.threads = 1}).value();
  EXPECT_GT(expected.triangles.size(), 3000u);
  for (int threads = 0; threads <= 16; ++threads)
    for (const char* backend : {"simd", "paper"}) {
      SCOPED_TRACE(std::string(backend) + ", " + std::to_string(threads) + " threads");
      const Scene scene = test::scene_of(placed);  // fresh trees
      test::expect_same(expected, scene.collide({.threads = threads, .backend = backend}).value());
    }
}

/// Each round meshes without a single node; every thread asks all questions in another order, so all split at once.
TEST(ConcurrentQueries, OfSharedFreshMeshesAgree) {
  const scenes::MeshData knot = scenes::torus_knot_of(968);
  const std::vector<Question> asked = questions(1, 4);
  std::vector<Contacts> expected;
  const Mesh plain_a = test::mesh_of(knot, 2), plain_b = test::mesh_of(knot, 5);
  std::size_t contacts = 0;
  for (const Question& q : asked) {
    expected.push_back(collide(plain_a, q.a, plain_b, q.b, {.threads = 1}).value());
    contacts += expected.back().triangles.size();
  }
  EXPECT_GT(contacts, 500u);
  for (int round = 0; round < 8; ++round) {
    const Mesh a = test::mesh_of(knot, 2), b = test::mesh_of(knot, 5);
    std::vector<std::vector<std::optional<Contacts>>> found(8, std::vector<std::optional<Contacts>>(asked.size()));
    on_threads(8, [&](int thread) {
      for (std::size_t i = 0; i < asked.size(); ++i) {
        const std::size_t k = (i + static_cast<std::size_t>(thread)) % asked.size();
        const Options options{.threads = thread % 2 == 0 ? 1 : 0, .backend = round % 2 == 0 ? "simd" : "paper"};
        const auto result = collide(a, asked[k].a, b, asked[k].b, options);
        if (result) found[static_cast<std::size_t>(thread)][k] = *result;
      }
    });
    std::uint64_t built = 0;
    for (const auto& by_thread : found)
      for (std::size_t k = 0; k < asked.size(); ++k) {
        ASSERT_TRUE(by_thread[k]);
        test::expect_same(expected[k], *by_thread[k]);
        built += by_thread[k]->statistics.nodes_built;
      }
    // Every node was made by one query alone: all together have made no more than the whole trees have.
    EXPECT_GT(built, 0u);
    EXPECT_LE(built, 4 * knot.triangle_count());
  }
}

/// So large that the making of single nodes is shared: by queries on the caller's threads and on TBB's, and by whole
/// builds, while each may hold what another waits for.
TEST(ConcurrentQueries, OfLargeFreshMeshesAgree) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  const scenes::MeshData plane = scenes::bumpy_grid(220, 220);
  const Pose pose{.t = {0.3, 0.2, 0.01}};
  const Mesh plain = test::mesh_of(plane);
  const Contacts expected = collide(plain, {}, plain, pose, {.threads = 1}).value();
  EXPECT_GT(expected.triangles.size(), 10000u);
  for (int round = 0; round < 4; ++round) {
    const Mesh a = test::mesh_of(plane), b = test::mesh_of(plane);
    std::vector<std::optional<Contacts>> found(6);
    const auto ask = [&](int thread) {
      if (thread % 3 == 1 && !(thread % 2 == 0 ? a : b).build_tree(thread % 4)) return;
      const auto result = collide(a, {}, b, pose, {.threads = (thread + round) % 4});
      if (result) found[static_cast<std::size_t>(thread)] = *result;
    };
    if (round % 2 == 0) {
      on_threads(6, ask);
    } else {
      schedule::run_tasks(std::vector<int>{0, 1, 2, 3, 4, 5}, 0, [&](int thread, const auto&) { ask(thread); });
    }
    for (const auto& contacts : found) {
      ASSERT_TRUE(contacts);
      test::expect_same(expected, *contacts);
    }
  }
}

TEST(ConcurrentQueries, OfOneSceneAgree) {
  scenes::Random random(2);
  scenes::PlacedScene placed = scenes::scattered(random, scenes::torus_knot_of(968), 8, 4);
  const Contacts expected = test::scene_of(placed).collide({.threads = 1}).value();
  EXPECT_FALSE(expected.triangles.empty());
  for (const bool updated : {false, true}) {
    Scene scene = test::scene_of(placed);
    EXPECT_TRUE(!updated || scene.update());
    const Scene& shared = scene;
    std::vector<std::optional<Contacts>> found(6);
    on_threads(6, [&](int thread) {
      const auto result = shared.collide({.threads = thread % 3});
      if (result) found[static_cast<std::size_t>(thread)] = *result;
    });
    for (const auto& contacts : found) {
      ASSERT_TRUE(contacts);
      test::expect_same(expected, *contacts);
    }
  }
}

/// Called from TBB's workers, busy for the caller, which round their own way.
TEST(ConcurrentQueries, FromTheCallersWorkersInAnyModeAgree) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968), 4);
  const Question asked = questions(3, 1)[0];
  const Mesh plain = test::mesh_of(scenes::torus_knot_of(968), 4);
  const Contacts expected = collide(plain, asked.a, plain, asked.b, {.threads = 1}).value();
  EXPECT_FALSE(expected.triangles.empty());
  constexpr std::array kRoundings{FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  std::vector<std::optional<Contacts>> found(24);
  std::atomic<int> touched{0};
  std::vector<std::size_t> calls(found.size());
  std::iota(calls.begin(), calls.end(), std::size_t{0});
  schedule::run_tasks(calls, 8, [&](std::size_t i, const auto&) {
    const test::CallersMode mode(kRoundings[i % 4], i % 3 == 0);
    const auto result = collide(knot, asked.a, knot, asked.b, {.threads = static_cast<int>(i % 4)});
    if (!mode.is_untouched()) ++touched;
    if (result) found[i] = *result;
  });
  EXPECT_EQ(touched, 0);
  for (const auto& contacts : found) {
    ASSERT_TRUE(contacts);
    test::expect_same(expected, *contacts);
  }
}

TEST(ConcurrentQueries, OneMayBeStoppedWhileOthersGoOn) {
  const Mesh plane = test::mesh_of(scenes::flat_grid(60, 60));
  const std::size_t expected = collide(plane, {}, plane, {}, {.threads = 1})->triangles.size();
  std::stop_source source;
  std::array<std::atomic<int>, 3> outcomes{};  // full answers, cancelled, wrong
  on_threads(5, [&](int thread) {
    if (thread == 0) {
      source.request_stop();
      return;
    }
    Options options;
    if (thread % 2 == 0) options.stop = source.get_token();
    const auto result = collide(plane, {}, plane, {}, options);
    const bool cancelled = !result && result.error().code == Code::cancelled;
    const bool full = result && result->triangles.size() == expected;
    ++outcomes[full ? 0 : cancelled && thread % 2 == 0 ? 1 : 2];
  });
  EXPECT_EQ(outcomes[2], 0);
  EXPECT_EQ(outcomes[0] + outcomes[1], 4);
  EXPECT_GE(outcomes[0], 2);
}

}  // namespace
}  // namespace impinge
