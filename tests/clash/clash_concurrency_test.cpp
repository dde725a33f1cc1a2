// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "impinge/clash.hpp"
#include "measure/nearest.hpp"
#include "pipeline/mesh_state.hpp"
#include "scenes/solids.hpp"
#include "tests/clash/same_clashes.hpp"
#include "tests/core/support.hpp"
#include "tests/pipeline/crowd.hpp"

/// Searches for clashes on several threads, several at once, watched and stopped from others.
namespace impinge {
namespace {

/// Boxes flush with each other, tangled surfaces, and parts in parts.
Scene scene_of_parts(std::uint64_t seed) {
  scenes::PlacedScene placed = test::crowd(seed);
  placed.meshes.push_back(scenes::box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}, 2));
  placed.objects.push_back({.mesh = static_cast<std::uint32_t>(placed.meshes.size() - 1)});
  return test::scene_of(placed);
}

ClashOptions everything(int threads) {
  return {.tolerance = std::nullopt, .clearance = 0.01, .regions = true, .threads = threads};
}

TEST(Clashes, AreTheSameForEveryThreadCountAndAtOnce) {
  const Clashes expected = find_clashes(scene_of_parts(1), everything(1)).value();
  EXPECT_GT(expected.pairs.size(), 20U);
  const Scene shared = scene_of_parts(1);
  std::vector<std::optional<Clashes>> found(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i)
    threads.emplace_back([&, i] {
      const Scene own = scene_of_parts(1);
      auto clashes = find_clashes(i < 2 ? shared : own, everything(i % 2 == 0 ? 4 : 1));
      if (clashes) found[i] = *std::move(clashes);
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::optional<Clashes>& clashes : found) {
    ASSERT_TRUE(clashes);
    test::expect_same(expected, *clashes);
  }
}

/// `done` never falls and never passes `total`, which is set once; in the end all is done.
TEST(Clashes, TellTheirProgressToOtherThreads) {
  const Scene scene = scene_of_parts(2);
  Progress progress;
  ClashOptions options = everything(4);
  options.progress = &progress;
  std::atomic<bool> has_ended{false};
  std::atomic<int> faults{0};
  std::thread watcher([&] {
    std::uint64_t last_done = 0, last_total = 0;
    while (!has_ended) {
      const std::uint64_t done = progress.done, total = progress.total;
      if (done < last_done || (last_total > 0 && total != last_total) || (total > 0 && done > total)) ++faults;
      last_done = done, last_total = total;
      std::this_thread::yield();
    }
  });
  const auto clashes = find_clashes(scene, options);
  has_ended = true;
  watcher.join();
  ASSERT_TRUE(clashes);
  EXPECT_EQ(faults, 0);
  EXPECT_EQ(progress.done, progress.total);
  // Meshes looked through for self-crossings are in it, and parts.
  EXPECT_GT(progress.total, clashes->candidates + clashes->parts.size());
}

TEST(Clashes, MayBeStoppedFromAnotherThreadAtAnyTime) {
  const Scene scene = scene_of_parts(3);
  const Clashes expected = find_clashes(scene, everything(1)).value();
  for (std::uint64_t steps = 0; steps < 60; steps += 12) {
    Progress progress;
    std::stop_source source;
    ClashOptions options = everything(steps % 24 == 0 ? 4 : 1);
    options.progress = &progress, options.stop = source.get_token();
    std::atomic<bool> has_ended{false};
    std::thread other([&] {
      while (!has_ended && progress.done < steps) std::this_thread::yield();
      source.request_stop();
    });
    const auto clashes = find_clashes(scene, options);
    has_ended = true;
    other.join();
    if (clashes) {
      test::expect_same(expected, *clashes);
    } else {
      EXPECT_EQ(clashes.error().code, Code::cancelled);
    }
  }
}

/// A disc about its middle.
Mesh disc(int sides) {
  scenes::MeshData mesh{{0, 0, 0}, {}};
  const auto n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    mesh.xyz.insert(mesh.xyz.end(), {std::cos(angle), std::sin(angle), 0});
    mesh.triangles.insert(mesh.triangles.end(), {0, 1 + i, 1 + (i + 1) % n});
  }
  return test::mesh_of(mesh);
}

/// Asks, and has another thread stop it once it is at work.
template <class Ask>
void stop_soon(const Ask& ask) {
  std::stop_source source;
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    source.request_stop();
  });
  ask(source.get_token());
  other.join();
}

/// Each of these would take many minutes, and the test its time limit, did it not look at its token.
TEST(Stop, EndsWhatAllTrianglesAboutOneVertexWouldTake) {
  const Mesh large = disc(100000), middling = disc(12000);
  const hierarchy::PlacedTree placed = large.state().placed({});
  stop_soon([&](const std::stop_token& stop) {
    measure::near_pairs(
        placed, placed, 0, [](const TrianglePair&) { return true; }, stop);
  });
  stop_soon([&](const std::stop_token& stop) {
    const auto clash = judge(middling, {}, middling, {}, {.threads = 1, .stop = stop});
    ASSERT_FALSE(clash);
    EXPECT_EQ(clash.error().code, Code::cancelled);
  });
}

}  // namespace
}  // namespace impinge
