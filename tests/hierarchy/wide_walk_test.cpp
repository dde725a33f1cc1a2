// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/wide_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <thread>

#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/hierarchy/pinned.hpp"
#include "tests/hierarchy/tree_pair.hpp"

namespace impinge {
namespace {

using hierarchy::TreeRefPair;
using hierarchy::WalkCounts;
using hierarchy::WalkLimits;
using hierarchy::WideLeafPair;
using hierarchy::WideWalk;
using test::TreePair;
using test::TrianglePairs;

constexpr std::uint64_t kAll = std::numeric_limits<std::uint32_t>::max();

std::vector<WideLeafPair> walked(const WideWalk& walk, bool nearest_first, WalkCounts& counts) {
  std::vector<TreeRefPair> stack;
  std::vector<WideLeafPair> leaf_pairs;
  walk.start(stack, counts);
  walk.advance(stack, leaf_pairs, {.leaf_pairs = kAll, .box_tests = kAll, .nearest_first = nearest_first}, counts);
  EXPECT_TRUE(stack.empty());
  return leaf_pairs;
}

/// On every instruction set, in either order, with fresh trees and grown ones.
void expect_reaches_all(const scenes::PlacedScene& scene, std::initializer_list<std::uint32_t> leaf_sizes) {
  const std::vector<test::Contact> contacts = test::brute_force(scene);
  for (const std::uint32_t leaf_size : leaf_sizes) {
    SCOPED_TRACE("leaf size " + std::to_string(leaf_size));
    for (const std::int64_t set : test::instruction_sets()) {
      const test::OnInstructionSet on(set);
      const TreePair pair(scene, leaf_size);
      for (const bool nearest_first : {false, true}) {
        WalkCounts counts;
        const auto leaf_pairs = walked(pair.walk(), nearest_first, counts);
        ASSERT_NO_FATAL_FAILURE(test::expect_contains(test::triangles_of(leaf_pairs), pair.touching(contacts)));
        EXPECT_GE(64 * counts.box_tests, leaf_pairs.size());
      }
    }
  }
}

TEST(WideWalk, ReachesEveryPairThatTouchesAtMostOnce) {
  test::Seeded seeded(1);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 40)) {
    SCOPED_TRACE(named.name);
    ASSERT_NO_FATAL_FAILURE(expect_reaches_all(named.scene, {1, 3, 16, 64}));
  }
}

/// A flat fan of triangles about a pinned corner, the plane given by two directions in the world.
std::optional<scenes::MeshData> fan(const Point& corner, const Vec3& u, const Vec3& v, int n, const Pose& pose) {
  const std::optional<Vec3> pin = test::pinned(corner, pose);
  if (!pin) return std::nullopt;
  scenes::MeshData mesh;
  const std::uint32_t first = mesh.add_vertex(pin->x, pin->y, pin->z);
  // Beyond the triangles at the corner, others that only make the trees deeper.
  for (int ring = 1; ring <= 3; ++ring)
    for (int i = 0; i <= n; ++i) {
      const double s = static_cast<double>(i) / n;
      const Vec3 p = test::unposed(corner + (ring / 3.0) * ((1 - s) * u + s * v), pose);
      mesh.add_vertex(p.x, p.y, p.z);
    }
  const auto at = [&](int ring, int i) { return static_cast<std::uint32_t>(1 + (ring - 1) * (n + 1) + i); };
  for (int i = 0; i < n; ++i) {
    mesh.add_triangle(first, at(1, i), at(1, i + 1));
    for (int ring = 1; ring < 3; ++ring) {
      mesh.add_triangle(at(ring, i), at(ring + 1, i), at(ring + 1, i + 1));
      mesh.add_triangle(at(ring, i), at(ring + 1, i + 1), at(ring, i + 1));
    }
  }
  return mesh;
}

/// Two flat fans that share just a corner, on opposite sides of it: nothing but the slack keeps their boxes together,
/// and the corner is far from the boxes' centres, where a matrix off a rotation shifts it most.
TEST(WideWalk, ReachesACornerThatIsAllThatIsShared) {
  int attacks = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    std::array<Pose, 2> poses;
    const double reach = std::array{0.0, 1.0, 1e6, 1e15}[seed % 4];
    for (Pose& pose : poses) {
      pose = scenes::random_motion(random, reach);
      if (seed % 3 != 0) pose.R = scenes::stretched_rotation(random, 9e-7);
      if (seed % 2 == 0) pose.t = poses[0].t;
    }
    const double size = std::ldexp(1.0, random.integer(-20, 20)), other = seed % 5 == 0 ? size * 0x1p-30 : size;
    const Mat3 axes = to_mat3(scenes::random_rotation(random));
    const Point corner{poses[0].t[0], poses[0].t[1], poses[0].t[2]};
    const double lift = random.integer(0, 1) * random.unit();
    const auto a = fan(corner, size * axes[0], size * axes[1], 4, poses[0]);
    const auto b = fan(corner, -other * (axes[0] - lift * axes[2]), -other * (axes[1] - lift * axes[2]), 4, poses[1]);
    if (!a || !b) continue;
    scenes::PlacedScene scene = scenes::pair_scene(*a, *b);
    for (std::size_t i = 0; i < 2; ++i) scene.objects[i].pose = poses[i];
    ASSERT_FALSE(test::brute_force(scene).empty());
    ASSERT_NO_FATAL_FAILURE(expect_reaches_all(scene, {1, 4, 64}));
    ++attacks;
  }
  EXPECT_GT(attacks, 200);
}

/// A mesh whose extent is 2^-k of the other's, at a vertex, on an edge and inside a triangle of it.
TEST(WideWalk, ReachesWhatTouchesInMeshesOfDifferentSizes) {
  for (const int k : {1, 20, 60, 200, 300}) {
    SCOPED_TRACE(k);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      test::Seeded seeded(seed);
      const double small = std::ldexp(1.0, -k);
      // Corners on integers from -2 to 2: some of its triangles have the origin as a corner, on an edge or inside.
      const scenes::MeshData large = scenes::shifted(scenes::integer_soup(seeded.random, 80, 4), -2, -2, -2);
      scenes::MeshData tiny = scenes::shifted(scenes::integer_soup(seeded.random, 40, 2), -1, -1, -1);
      tiny = scenes::scaled(std::move(tiny), small, small, small);
      ASSERT_NO_FATAL_FAILURE(expect_reaches_all(scenes::pair_scene(large, tiny), {1, 16}));
      ASSERT_NO_FATAL_FAILURE(expect_reaches_all(scenes::pair_scene(tiny, large), {3}));
    }
  }
}

/// A leaf of their one tree is met as that of either.
TEST(WideWalk, ReachesWhatTouchesInTwoCopiesOfOneMesh) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    scenes::MeshData mesh = scenes::box({-10, -10, -4}, {10, 10, 6});
    for (int i = 0; i < 12; ++i)
      mesh = scenes::joined(std::move(mesh), scenes::shifted(scenes::uv_sphere(7, 6, 0.4), random.uniform(-8, 8),
                                                             random.uniform(-8, 8), random.uniform(-4, 6)));
    scenes::PlacedScene scene{.meshes = {mesh}, .objects = {{.mesh = 0}, {.mesh = 0}}};
    scene.objects[1].pose = scenes::random_motion(random, 1);
    ASSERT_NO_FATAL_FAILURE(expect_reaches_all(scene, {12, 16}));
  }
}

/// Needles, which are one leaf and whose planes are hardly known, and a mesh of small triangles that shares a corner of
/// one: the boxes of its nodes' children and its leaves are held against the needles' boxes and planes.
TEST(WideWalk, ReachesSmallTrianglesAtTheCornersOfLargeNeedles) {
  int attacks = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    std::array<Pose, 2> poses;
    for (Pose& pose : poses) {
      pose = scenes::random_motion(random, std::array{0.0, 1.0, 1e6}[seed % 3]);
      if (seed % 2 != 0) pose.R = scenes::stretched_rotation(random, 9e-7);
    }
    const Mat3 axes = to_mat3(scenes::random_rotation(random));
    const Point corner{poses[0].t[0], poses[0].t[1], poses[0].t[2]};
    const Vec3 along = axes[0] + random.uniform(-1, 1) * axes[1];
    const Vec3 aside = std::ldexp(1.0, -random.integer(10, 30)) * axes[2];
    const double small = std::ldexp(1.0, -random.integer(2, 24));
    const auto needles = fan(corner, along, along + aside, 2, poses[0]);
    // To all sides, or away from the needles: just their bounds keep the corner then.
    const Vec3 u = seed % 4 == 0 ? axes[2] : axes[0] - axes[1], v = seed % 4 == 0 ? axes[2] - axes[0] : axes[2];
    const auto other = fan(corner, small * u, small * v, 6, poses[1]);
    if (!needles || !other) continue;
    scenes::PlacedScene scene = scenes::pair_scene(*needles, *other);
    for (std::size_t i = 0; i < 2; ++i) scene.objects[i].pose = poses[i];
    ASSERT_FALSE(test::brute_force(scene).empty());
    ASSERT_NO_FATAL_FAILURE(expect_reaches_all(scene, {12, 64}));
    ++attacks;
  }
  EXPECT_GT(attacks, 300);
}

TEST(WideWalk, ReachesSingleTrianglesThatAreRootsOfTheirTrees) {
  test::Seeded seeded(3);
  int touching = 0;
  for (int i = 0; i < 300; ++i) {
    const auto soup = [&] { return scenes::integer_soup(seeded.random, 1, 2); };
    const scenes::PlacedScene scene =
        scenes::moved(scenes::pair_scene(soup(), soup()), scenes::random_motion(seeded.random, i % 2 == 0 ? 1 : 1e6));
    touching += static_cast<int>(test::brute_force(scene).size());
    ASSERT_NO_FATAL_FAILURE(expect_reaches_all(scene, {1, 256}));
  }
  EXPECT_GT(touching, 50);
}

/// The boxes do their work: what is far apart costs one test, what touches lightly a small share of all.
TEST(WideWalk, PartsWhatIsApart) {
  const scenes::MeshData knot = scenes::torus_knot_of(968);
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    scenes::PlacedScene scene = scenes::shifted_pair(knot, {0, 0, 0});
    scene.objects[1].pose.t = {20, 0, 0};
    WalkCounts counts;
    EXPECT_TRUE(walked(TreePair(scene, 4).walk(), false, counts).empty());
    EXPECT_LE(counts.box_tests, 64u);

    scene.objects[1].pose.t = {5, 1, 0.3};  // the outermost of either reach each other
    const TreePair light(scene, 4);
    EXPECT_LT(walked(light.walk(), false, counts).size() * 50, light.all_leaf_pairs().size());

    // Above a floor of two triangles, by a tenth of its radius: more than its flattest nodes are thick.
    scene = scenes::pair_scene(scenes::box({-10, -10, -4}, {10, 10, 6}), scenes::uv_sphere(20, 21, 0.4));
    scene.objects[1].pose.t = {1, 2, -3.56};
    counts = {};
    EXPECT_TRUE(walked(TreePair(scene, 16).walk(), true, counts).empty());
    EXPECT_LE(counts.box_tests, 64u);
  }
}

TEST(WideWalk, MayBeCutIntoSlices) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    test::Seeded seeded(seed);
    // Two of a kind, or a sphere in the corner of a room, which is one leaf.
    const bool is_room = seed % 2 == 0;
    scenes::PlacedScene scene =
        is_room ? scenes::pair_scene(scenes::box({-10, -10, -4}, {10, 10, 6}), scenes::uv_sphere(20, 21, 0.4))
                : scenes::shifted_pair(scenes::torus_knot_of(968), {0.3, 0.2, 0.1});
    if (is_room) scene.objects[1].pose.t = {9.9, 9.8, -3.7};
    scene.objects[1].pose.R = scenes::random_rotation(seeded.random);
    const TreePair pair(scene, is_room ? 12 : 3);
    const WideWalk walk = pair.walk();
    WalkCounts counts;
    const std::vector<test::Contact> contacts = test::brute_force(scene);
    ASSERT_FALSE(contacts.empty());
    std::vector<std::vector<TreeRefPair>> stacks(1);
    std::vector<WideLeafPair> leaf_pairs;
    walk.start(stacks[0], counts);
    while (!stacks.empty()) {
      std::vector<TreeRefPair> stack = std::move(stacks.back());
      stacks.pop_back();
      const WalkLimits limits{.leaf_pairs = static_cast<std::size_t>(seeded.random.integer(1, 40)),
                              .box_tests = static_cast<std::uint64_t>(seeded.random.integer(1, 500)),
                              .at_once = static_cast<std::size_t>(seeded.random.integer(1, 32)),
                              .nearest_first = seeded.random.integer(0, 1) == 1};
      const std::size_t before = leaf_pairs.size();
      const std::uint64_t tests_before = counts.box_tests;
      walk.advance(stack, leaf_pairs, limits, counts);
      const std::size_t beyond = limits.at_once * 64;  // those at hand, of 64 tests each, are finished
      EXPECT_LT(leaf_pairs.size(), before + limits.leaf_pairs + beyond);
      EXPECT_LT(counts.box_tests, tests_before + limits.box_tests + beyond);
      const auto middle = stack.begin() + static_cast<std::ptrdiff_t>(stack.size() / 2);
      if (middle != stack.begin()) stacks.emplace_back(stack.begin(), middle);
      if (middle != stack.end()) stacks.emplace_back(middle, stack.end());
    }
    ASSERT_NO_FATAL_FAILURE(test::expect_contains(test::triangles_of(leaf_pairs), pair.touching(contacts)));
  }
}

/// Straight down to the nearest leaves, where a surface lies on itself.
TEST(WideWalk, NearestFirstFindsAFirstLeafPairSoon) {
  const TreePair pair(scenes::shifted_pair(scenes::bumpy_grid(64, 64), {0, 0, 0}), 4);
  const WideWalk walk = pair.walk();
  WalkCounts counts, plain;
  std::vector<TreeRefPair> stack;
  std::vector<WideLeafPair> leaf_pairs;
  walk.start(stack, counts);
  walk.advance(stack, leaf_pairs, {.leaf_pairs = 1, .box_tests = kAll, .at_once = 1, .nearest_first = true}, counts);
  EXPECT_FALSE(leaf_pairs.empty());
  EXPECT_LE(counts.box_tests, 64u * 8);
  walked(walk, false, plain);
  EXPECT_GT(plain.box_tests, 64u * 1000);
}

/// Threads take from each other's stacks while the trees grow under them.
TEST(WideWalk, OfThreadsThatShareItsStackIsWhole) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Seeded seeded(seed);
    scenes::PlacedScene scene = scenes::shifted_pair(scenes::torus_knot_of(968), {0.3, 0.2, 0.1});
    scene.objects[1].pose.R = scenes::random_rotation(seeded.random);
    WalkCounts plain;
    const TreePair alone(scene, 3);
    const TrianglePairs expected = test::triangles_of(walked(alone.walk(), false, plain));

    const TreePair shared(scene, 3);
    const WideWalk walk = shared.walk();
    std::mutex mutex;
    std::vector<TreeRefPair> common;
    std::vector<WideLeafPair> leaf_pairs;
    WalkCounts counts;
    int busy = 0;
    walk.start(common, counts);
    const auto work = [&] {
      std::vector<TreeRefPair> stack;
      std::vector<WideLeafPair> own;
      WalkCounts own_counts;
      bool was_busy = false;
      while (true) {
        {
          const std::lock_guard lock(mutex);
          if (was_busy) --busy;
          // Half of what is left is given away, half of what there is taken.
          common.insert(common.end(), stack.begin() + static_cast<std::ptrdiff_t>(stack.size() / 2), stack.end());
          stack.resize(stack.size() / 2);
          if (stack.empty()) {
            const auto from = common.begin() + static_cast<std::ptrdiff_t>(common.size() / 2);
            stack.assign(from, common.end());
            common.erase(from, common.end());
          }
          was_busy = !stack.empty();
          busy += was_busy ? 1 : 0;
          if (!was_busy && busy == 0) break;
        }
        if (stack.empty()) std::this_thread::yield();
        walk.advance(stack, own, {.leaf_pairs = 50, .box_tests = 500}, own_counts);
      }
      const std::lock_guard lock(mutex);
      leaf_pairs.insert(leaf_pairs.end(), own.begin(), own.end());
      counts.box_tests += own_counts.box_tests, counts.made.nodes += own_counts.made.nodes;
    };
    std::thread other(work);
    work();
    other.join();
    EXPECT_EQ(test::triangles_of(leaf_pairs), expected);
    EXPECT_EQ(counts.made.nodes, plain.made.nodes);
    EXPECT_EQ(counts.box_tests, plain.box_tests);
  }
}

}  // namespace
}  // namespace impinge
