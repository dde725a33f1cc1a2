// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <functional>
#include <thread>

#include "impinge/scene.hpp"
#include "paper/sweep_and_prune.hpp"
#include "scenes/placed.hpp"
#include "scenes/random.hpp"
#include "tests/broad/bodies.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scene::PlacedObject;

using test::box_at;
using test::lattice;
using test::lattice_pairs;

struct Found {
  std::size_t pairs;
  std::uint64_t comparisons;
};
Found find(const std::vector<PlacedObject>& objects) {
  paper::SweepAndPrune borders;
  borders.update({objects, nullptr});
  broad::ObjectPairs pairs;
  borders.find({objects, nullptr}, pairs);
  return {pairs.size(), borders.counts().sphere_tests};
}

TEST(SweepAndPrune, FindsTheNeighboursOfAHundredThousandBoxes) {
  EXPECT_EQ(find(lattice(50, 50, 40)).pairs, lattice_pairs(50, 50, 40));
}

TEST(SweepAndPrune, EndsEarlyWhenAskedToStop) {
  const std::vector<PlacedObject> objects = lattice(3, 3, 3);
  paper::SweepAndPrune borders;
  borders.update({objects, nullptr});
  std::stop_source stop;
  broad::ObjectPairs pairs;
  borders.find({objects, nullptr}, pairs, stop.get_token());
  EXPECT_FALSE(pairs.empty());
  const std::uint64_t comparisons = borders.counts().sphere_tests;
  EXPECT_GT(comparisons, 0u);
  stop.request_stop();
  borders.find({objects, nullptr}, pairs, stop.get_token());
  EXPECT_TRUE(pairs.empty());
  EXPECT_EQ(borders.counts().sphere_tests, comparisons);
}

/// If all were open at once, each would be held against fifty thousand others.
TEST(SweepAndPrune, PipesAlongOneAxisDoNotDegrade) {
  constexpr int n = 100000;
  const auto unit = [](int axis) { return Vec3{axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0}; };
  for (int axis = 0; axis < 3; ++axis) {
    SCOPED_TRACE("axis " + std::to_string(axis));
    const Vec3 along = unit(axis), across = unit((axis + 1) % 3);
    std::vector<PlacedObject> row, side_by_side, bundle;
    for (int i = 0; i < n; ++i) {
      // End to end along the axis; beside each other, each as long as all; and beside each other in both directions.
      row.push_back(box_at(1.0 * i * along, 0.5 * along + Vec3{0.1, 0.1, 0.1}));
      side_by_side.push_back(box_at(1.0 * i * across, 50000.0 * along + Vec3{0.1, 0.1, 0.1}));
      const Vec3 at = 1.0 * (i % 316) * across + 1.0 * (i / 316) * unit((axis + 2) % 3);
      bundle.push_back(box_at(at, 500.0 * along + Vec3{0.1, 0.1, 0.1}));
    }
    const Found in_row = find(row), in_order = find(side_by_side), in_bundle = find(bundle);
    EXPECT_EQ(in_row.pairs, n - 1u);
    EXPECT_EQ(in_order.pairs, 0u);
    EXPECT_EQ(in_bundle.pairs, 0u);
    EXPECT_EQ(in_row.comparisons, n - 1u);
    EXPECT_EQ(in_order.comparisons, 0u);
    EXPECT_LE(in_bundle.comparisons, 160u * n);  // with the others of its column
  }
}

/// An object's share in the first update: how many boxes, eight at a time, it is held against, and how many candidates
/// there are. And how many boxes, in a later update, one is held against that has left its room.
struct Cost {
  double box_tests, candidates, late_box_tests;
};
Cost cost_of(std::vector<PlacedObject> objects) {
  broad::NearPairs near_pairs;
  test::update(near_pairs, objects);
  const auto n = static_cast<double>(objects.size());
  const auto tests = static_cast<double>(near_pairs.box_tests());
  Cost cost{tests / n, static_cast<double>(near_pairs.candidates()) / n, 0};
  for (std::size_t i = 0; i < objects.size(); i += 10) {
    const Vec3 step = 0.5 * (objects[i].box.hi - objects[i].box.lo);
    objects[i] = box_at(objects[i].sphere.center + step, step);
  }
  test::update(near_pairs, objects);
  cost.late_box_tests = (static_cast<double>(near_pairs.box_tests()) - tests) / (n / 10);
  return cost;
}

std::vector<PlacedObject> scattered(int n, const Vec3& middle = {0, 0, 0}) {
  scenes::Random random(1);
  const double side = 1.5 * std::cbrt(n);
  std::vector<PlacedObject> objects;
  for (int i = 0; i < n; ++i) {
    const Vec3 at{random.uniform(-side, side), random.uniform(-side, side), random.uniform(-side, side)};
    objects.push_back(box_at(middle + at, {1, 1, 1}));
  }
  return objects;
}

TEST(NearPairs, FindTheNeighboursOfAHundredThousandBoxes) {
  broad::NearPairs near_pairs;
  const std::vector<PlacedObject> objects = lattice(50, 50, 40);
  test::update(near_pairs, objects);
  EXPECT_EQ(test::pairs_of(near_pairs, {objects}).size(), lattice_pairs(50, 50, 40));
}

TEST(NearPairs, CostNearlyTheSameAnObjectInAnyCrowd) {
  const Cost small = cost_of(scattered(2000)), large = cost_of(scattered(128000));
  EXPECT_LT(small.box_tests, 5);
  EXPECT_LT(large.box_tests, 1.5 * small.box_tests);
  EXPECT_LT(large.candidates, 2);
  EXPECT_LT(small.late_box_tests, 15);
  EXPECT_LT(large.late_box_tests, 2 * small.late_box_tests);
}

/// What one object far away, or a crowd elsewhere, must not spoil.
TEST(NearPairs, CostTheSameWhereverTheCrowdIs) {
  std::vector<PlacedObject> objects = scattered(20000);
  const Cost alone = cost_of(objects);
  objects[12345] = box_at({0, -1e12, 0}, {1, 1, 1});
  const Cost with_outlier = cost_of(objects);
  EXPECT_LT(with_outlier.box_tests, 1.1 * alone.box_tests);
  EXPECT_LT(with_outlier.late_box_tests, 1.3 * alone.late_box_tests);
  const std::vector<PlacedObject> elsewhere = scattered(20000, {0, 1e9, 0});
  objects.insert(objects.end(), elsewhere.begin(), elsewhere.end());
  const Cost both = cost_of(objects);
  EXPECT_LT(both.box_tests, 1.2 * alone.box_tests);
  EXPECT_LT(both.candidates, 1.2 * alone.candidates);
  EXPECT_LT(both.late_box_tests, 1.3 * alone.late_box_tests);
}

/// A sweep along any axis would have a third of them open at once.
TEST(NearPairs, CostLittleAmongPipesAlongThreeAxes) {
  const Cost small = cost_of(test::pipes_along_three_axes(3000)), large = cost_of(test::pipes_along_three_axes(48000));
  EXPECT_EQ(large.candidates, 0);
  EXPECT_LT(large.box_tests, 100);
  EXPECT_LT(large.box_tests, 4.5 * small.box_tests);  // the root of 16, as a pipe passes so many more
}

/// Room for the motion of large thin things must not reach across all their neighbours.
TEST(NearPairs, KeepPlatesInAStackApartWhileTheyMove) {
  constexpr int n = 5000;
  for (const Vec3& velocity : {Vec3{0.1, 0, 0}, {0, 0, 0.1}, {0.01, 0.01, 0.0001}}) {
    broad::NearPairs near_pairs;
    for (int frame = 0; frame < 30; ++frame) {
      std::vector<PlacedObject> plates;
      for (int i = 0; i < n; ++i)
        plates.push_back(box_at(1.0 * frame * velocity + Vec3{0, 0, 0.004 * i}, {1, 1, 0.001}));
      test::update(near_pairs, plates);
      ASSERT_EQ(near_pairs.candidates(), 0u);
    }
  }
}

TEST(NearPairs, CostLittleInASlowFrame) {
  constexpr int n = 20000;
  std::vector<PlacedObject> objects = scattered(n);
  scenes::Random random(2);
  std::vector<Vec3> velocities;
  for (int i = 0; i < n; ++i)
    velocities.push_back({random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01)});
  broad::NearPairs near_pairs;
  std::uint64_t most = 0;
  for (int frame = 0; frame < 200; ++frame) {
    for (std::size_t i = 0; i < n; ++i) objects[i] = box_at(objects[i].sphere.center + velocities[i], {1, 1, 1});
    const std::uint64_t before = near_pairs.box_tests();
    test::update(near_pairs, objects);
    if (frame >= 40) most = std::max(most, near_pairs.box_tests() - before);
    ASSERT_LT(near_pairs.candidates(), 3u * n);
  }
  EXPECT_GT(most, 0u);
  EXPECT_LT(most, 1u * n);
}

/// On a thread for each part, in whatever order they end.
void on_a_thread_each(std::size_t n, const std::function<void(std::size_t)>& body) {
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < n; ++i) threads.emplace_back([&body, i] { body(i); });
  for (std::thread& thread : threads) thread.join();
}

TEST(NearPairs, AreTheSameHoweverTheWorkIsShared) {
  std::vector<PlacedObject> objects = lattice(30, 30, 30);
  broad::NearPairs alone, shared;
  broad::NearPairs::Scratch scratch;
  for (int frame = 0; frame < 5; ++frame) {
    shared.reserve(objects.size());
    for (std::uint32_t i = 0; i < objects.size(); ++i) shared.place(i, objects[i]);
    shared.update(on_a_thread_each);
    test::update(alone, objects);
    broad::ObjectPairs pairs(1, {7, 7});
    shared.find({objects}, pairs, scratch, {.for_each = on_a_thread_each});
    const broad::ObjectPairs expected = test::pairs_of(alone, {objects});
    ASSERT_TRUE(pairs == expected);
    ASSERT_GT(shared.candidates(), 100000u);  // enough to share
    ASSERT_EQ(shared.candidates(), alone.candidates());
    ASSERT_EQ(shared.box_tests(), alone.box_tests());
    for (std::size_t i = 0; i < objects.size(); i += 3)  // many leave their rooms, fewer than make building anew pay
      objects[i] = box_at(objects[i].sphere.center + Vec3{0.3, 0.2, 0.1}, {0.5, 0.5, 0.5});
  }
  std::stop_source stop;
  stop.request_stop();
  broad::ObjectPairs pairs;
  shared.find({objects}, pairs, scratch, {.stop = stop.get_token(), .for_each = on_a_thread_each});
  EXPECT_TRUE(pairs.empty());
}

/// Through the whole pipeline; each joint is that of the first two pipes.
TEST(Scene, HoldsAHundredThousandPipes) {
  constexpr int n = 100000;
  const auto joint = test::scene_of(scenes::pipe_row(2, 3)).collide();
  ASSERT_TRUE(joint);
  const std::vector<test::Contact> expected = test::listed(*joint);
  ASSERT_FALSE(expected.empty());
  Scene scene = test::scene_of(scenes::pipe_row(n, 3));
  ASSERT_TRUE(scene.update());
  const auto found = scene.collide();
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(found->objects.size(), n - 1u);
  const std::vector<test::Contact> contacts = test::listed(*found);
  ASSERT_EQ(contacts.size(), (n - 1) * expected.size());
  for (std::uint32_t i = 0; i < contacts.size(); ++i) {
    const auto row = static_cast<std::uint32_t>(i / expected.size());
    const test::Contact& first = expected[i % expected.size()];
    ASSERT_EQ(contacts[i], (test::Contact{row, row + 1, first[2], first[3], first[4]}));
  }
}

}  // namespace
}  // namespace impinge
