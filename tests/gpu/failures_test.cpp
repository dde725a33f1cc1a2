// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Devices that are lost, run out of memory, or have little room: the answer is the same.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <stop_token>
#include <string_view>
#include <thread>

#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
#include "tests/gpu/environment.hpp"
#include "tests/pipeline/crowd.hpp"

namespace impinge {
namespace {

using test::WithLimits;

const scenes::PlacedScene& placed() {
  static const scenes::PlacedScene scene = test::crowd(3);
  return scene;
}
const Contacts& expected() {
  static const Contacts contacts = test::scene_of(placed()).collide({.backend = "paper"}).value();
  return contacts;
}

TEST(DeviceFailures, ListsThatAreTooShortAreFilledAgainAndAgain) {
  for (const std::uint32_t leaf_pairs : {1u, 300u})
    for (const std::uint32_t hits : {1u, 2000u}) {
      const WithLimits limits({.stack = 1, .leaf_pairs = leaf_pairs, .hits = hits, .most_groups = 2});
      const auto found = test::scene_of(placed()).collide({.backend = "gpu"});
      ASSERT_TRUE(found);
      EXPECT_TRUE(found->warnings.empty()) << found->warnings[0];
      test::expect_same(expected(), *found);
    }
}

/// llvmpipe ends a shader after so many turns of its loops, without a word: a group must not have too much to do.
TEST(DeviceFailures, OneGroupDoesTheWorkOfMany) {
  test::Seeded seeded(1);
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(229));
  Scene scene;
  for (int i = 0; i < 48; ++i) ASSERT_TRUE(scene.add(knot, scenes::random_motion(seeded.random, 0.1)));
  const Contacts wanted = scene.collide({.backend = "simd"}).value();
  const WithLimits limits({.most_groups = 1});
  const auto found = scene.collide({.backend = "gpu"});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->warnings.empty()) << found->warnings[0];
  test::expect_same(wanted, *found);
}

/// Behind each buffer lies a guard that shaders could write to.
TEST(DeviceFailures, NothingIsWrittenBeyondABuffersEnd) {
  std::atomic<int> overruns = 0;
  {
    for (const std::uint32_t size : {1u, 3000u, 0u}) {
      const WithLimits limits({.stack = size, .leaf_pairs = size, .hits = size, .overruns = &overruns});
      const auto found = test::scene_of(placed()).collide({.backend = "gpu"});
      ASSERT_TRUE(found);
      EXPECT_TRUE(found->warnings.empty()) << found->warnings[0];
      test::expect_same(expected(), *found);
    }
  }
  EXPECT_EQ(overruns, 0);
}

/// A walk that has far more open than its list holds, and is at its deepest most of the time.
TEST(DeviceFailures, AWalkStaysInTheShortestList) {
  std::atomic<int> overruns = 0;
  {
    const WithLimits limits({.stack = 1, .overruns = &overruns});
    const Mesh sheet = test::mesh_of(scenes::bumpy_grid(100, 100, 0.25), 1);
    const Pose above{.t = {0, 0, 0.0625}};
    const auto found = collide(sheet, {}, sheet, above, {.backend = "gpu"});
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->warnings.empty()) << found->warnings[0];
    const Contacts wanted = collide(sheet, {}, sheet, above).value();
    EXPECT_GT(wanted.statistics.leaf_pairs, 10'000u);
    test::expect_same(wanted, *found);
  }
  EXPECT_EQ(overruns, 0);
}

TEST(DeviceFailures, AGuardThatWasWrittenToIsNoticed) {
  std::atomic<int> overruns = 0;
  {
    const WithLimits limits({.overruns = &overruns});
    gpu::Device& device = gpu::Devices::of_process().choose("").opened->device;
    const gpu::Buffer buffer(device, 400, gpu::Buffer::Use::device);
    gpu::Commands commands(device);
    commands.start([&](VkCommandBuffer recorded) { vkCmdFillBuffer(recorded, buffer.handle(), 400, 4, 0); });
    commands.wait();
  }
  EXPECT_EQ(overruns, 1);
}

/// Of the first allocations and submissions, each fails once.
class DeviceFails : public testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(DeviceFails, AndTheCpuFinishesItsWork) {
  const Options options{.backend = GetParam().first, .device_share = GetParam().second};
  Options first = options;
  first.find = Options::Find::first;
  for (const bool is_loss : {false, true}) {
    int warned = 0;
    const bool is_slow = test::is_smaller_set() || options.backend == "raster";
    for (int at = 0; at < 40; at += is_slow ? 7 : 1) {
      SCOPED_TRACE((is_loss ? "lost at submission " : "no memory at allocation ") + std::to_string(at));
      std::atomic<int> countdown(at);
      gpu::Limits limits;
      (is_loss ? limits.lose_device : limits.fail_allocation) = &countdown;
      const WithLimits with(limits);
      const Scene scene = test::scene_of(placed());
      const auto found = scene.collide(options);
      ASSERT_TRUE(found) << found.error().message;
      test::expect_same(expected(), *found);
      warned += static_cast<int>(found->warnings.size());
      if (countdown >= 0) break;  // nothing failed: there are no more
      // A device that was lost stays so; one that ran out of memory is asked again.
      const auto again = scene.collide(options);
      ASSERT_TRUE(again);
      test::expect_same(expected(), *again);
      gpu::Devices::of_process().reopen(limits, true);
      countdown = at;
      EXPECT_EQ(scene.collide(first).value().objects, expected().objects);
    }
    EXPECT_GT(warned, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, DeviceFails,
                         testing::Values(std::pair("gpu", -1.0), std::pair("hybrid", 0.5), std::pair("raster", -1.0)),
                         [](const auto& of) { return std::string(of.param.first); });

TEST(DeviceFailures, AMeshThatFitsInNoBufferIsLeftToTheCpu) {
  const WithLimits limits({.largest_buffer = 400'000, .page = 400'000});
  scenes::PlacedScene scene = placed();
  scene.meshes.push_back(scenes::torus_knot_of(20'000));
  scene.objects.push_back({.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1)});
  const auto found = test::scene_of(scene).collide({.backend = "gpu"});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->warnings.size(), 1u);
  EXPECT_NE(found->warnings[0].find("room"), std::string::npos) << found->warnings[0];
  test::expect_same(test::scene_of(scene).collide().value(), *found);
}

/// With room for a few meshes, those that were not used for long make way, and come back when they are asked for.
TEST(DeviceFailures, MeshesMakeWayForOthers) {
  const WithLimits limits(
      {.budget = 2'500'000, .page = 400'000, .stack = 20'000, .leaf_pairs = 10'000, .hits = 10'000});
  std::vector<Mesh> meshes;
  for (int i = 0; i < 12; ++i) meshes.push_back(test::mesh_of(scenes::torus_knot_of(2000 + 16 * i)));
  const auto opened = gpu::Devices::of_process().choose("").opened;
  ASSERT_TRUE(opened);
  std::size_t most = 0;
  for (int round = 0; round < 2; ++round)
    for (std::size_t i = 0; i + 1 < meshes.size(); ++i) {
      const Pose pose{.t = {0.5, 0.25, 0}};
      const auto found = collide(meshes[i], {}, meshes[i + 1], pose, {.backend = "gpu"});
      ASSERT_TRUE(found);
      ASSERT_TRUE(found->warnings.empty()) << found->warnings[0];
      test::expect_same(collide(meshes[i], {}, meshes[i + 1], pose).value(), *found);
      most = std::max(most, opened->meshes.size());
      EXPECT_LE(opened->device.bytes_in_use(), 2'500'000u);
    }
  EXPECT_LT(most, meshes.size());
  EXPECT_GT(most, 2u);
  meshes.clear();
  EXPECT_EQ(opened->meshes.size(), 0u);
}

std::uint64_t resident_pages() {
  std::uint64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident;
}

TEST(DeviceFailures, AThousandQueriesUseNoMoreMemoryThanTen) {
  const WithLimits limits({});
  const Scene kept = test::scene_of(placed());
  std::uint64_t after_ten = 0, pages_after_a_tenth = 0;
  const int queries = test::is_smaller_set() ? 100 : 1000;
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(100));
  for (int i = 0; i < queries; ++i) {
    // A mesh of its own each time, beside one that stays.
    const Mesh mesh = test::mesh_of(scenes::torus_knot_of(100));
    const auto found = collide(mesh, {}, knot, {.t = {0.1, 0.2, 0.3}}, {.backend = "gpu"});
    ASSERT_TRUE(found);
    ASSERT_TRUE(found->warnings.empty());
    const auto opened = gpu::Devices::of_process().choose("").opened;
    if (i == 10) after_ten = opened->device.bytes_in_use();
    if (i == queries / 10) pages_after_a_tenth = resident_pages();
    if (i > 10) {
      ASSERT_EQ(opened->device.bytes_in_use(), after_ten);
    }
  }
  // The driver's own grow-as-needed apart: 8 MiB of 4 KiB pages.
  EXPECT_LT(resident_pages(), pages_after_a_tenth + 2048);
}

TEST(DeviceFailures, EightThreadsShareADevice) {
  const WithLimits limits({});
  const Scene scene = test::scene_of(placed());
  const Contacts& wanted = expected();
  constexpr std::string_view backends[] = {"gpu", "raster", "hybrid"};
  std::vector<std::jthread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&, i] {
      for (int round = 0; round < 3; ++round) {
        const auto found = scene.collide({.threads = 1 + i % 2, .backend = backends[i % 3]});
        ASSERT_TRUE(found);
        EXPECT_TRUE(found->warnings.empty());
        test::expect_same(wanted, *found);
      }
    });
}

/// A query is stopped while its walk is under way, and others want the memory of its mesh.
TEST(DeviceFailures, AStoppedWalkHasEndedBeforeItsMeshMayGo) {
  const WithLimits limits({.budget = 32u << 20, .page = 1u << 20});
  const Mesh large = test::mesh_of(scenes::torus_knot_of(200'000)), tiny = test::mesh_of(scenes::torus_knot_of(100));
  ASSERT_TRUE(large.build_tree());
  for (int round = 0; round < 4; ++round) {
    std::stop_source stop;
    std::atomic<bool> is_over = false;
    const std::jthread stopped([&] {
      const auto found = collide(large, {}, large, {.t = {0.001, 0.002, 0.001}},
                                 {.threads = 1, .backend = "gpu", .stop = stop.get_token()});
      EXPECT_TRUE(found || found.error().code == Code::cancelled);
      is_over = true;
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(150 + 40 * round));
    stop.request_stop();
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(1200);
    while (!is_over || std::chrono::steady_clock::now() < until) {
      const Mesh other = test::mesh_of(scenes::torus_knot_of(60'000));
      EXPECT_TRUE(collide(other, {}, tiny, {.t = {50, 0.1, 0}}, {.threads = 1, .backend = "gpu"}));
      EXPECT_TRUE(collide(other, {}, tiny, {.t = {0.1, 0.1, 0}}, {.threads = 1, .backend = "gpu"}));
    }
  }
}

TEST(DeviceFailures, ADeviceThatIsNotThereIsNamedWithThoseThatAre) {
  for (const char* name : {"Voodoo 2", "256", "99999999999999999999999"}) {  // lavapipe's name says "256 bits"
    const auto found = test::scene_of(placed()).collide({.backend = "gpu", .device = name});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, Code::no_device);
    EXPECT_NE(found.error().message.find("0 '"), std::string::npos) << found.error().message;
  }
  EXPECT_TRUE(test::scene_of(placed()).collide({.backend = "gpu", .device = "0"}));
}

}  // namespace
}  // namespace impinge
