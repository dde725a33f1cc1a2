// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "impinge/scene.hpp"
#include "scenes/random.hpp"
#include "scenes/shapes.hpp"
#include "tests/broad/bodies.hpp"
#include "tests/core/support.hpp"
#include "tests/memory/own_allocator.hpp"

namespace impinge {
namespace {

using test::allocations;
using test::countdown;
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
  for (const int frames : {-1, 0, 1, 3, 60}) {  // far arrivals; from nothing; few have left their rooms, many, all
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
