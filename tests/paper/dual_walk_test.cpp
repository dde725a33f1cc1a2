// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/dual_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "broad/may_touch.hpp"
#include "scene/scene_view.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using paper::LeafPairs;
using paper::NodePair;
using TrianglePairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

constexpr std::size_t kAll = std::numeric_limits<std::uint32_t>::max();

/// The two objects of a scene with trees of their own.
struct Walked {
  explicit Walked(const scenes::PlacedScene& scene, std::uint32_t leaf_size)
      : meshes(test::meshes_of(scene)),
        pose_a(scene.objects[0].pose),
        pose_b(scene.objects[1].pose),
        a(test::numbers_of(meshes[scene.objects[0].mesh])),
        b(test::numbers_of(meshes[scene.objects[1].mesh])),
        tree_a(a, leaf_size),
        tree_b(b, leaf_size),
        placed{scene::place(a, pose_a, 0), scene::place(b, pose_b, 0)},
        overlap(intersection(placed[0].box, placed[1].box)) {}

  [[nodiscard]] bool reached() const { return broad::may_touch({placed, nullptr}, 0, 1); }
  paper::DualWalk walk() { return {{tree_a, a, pose_a}, {tree_b, b, pose_b}, overlap}; }

  std::vector<Mesh> meshes;
  Pose pose_a, pose_b;
  const MeshData &a, &b;
  paper::ObbTree tree_a, tree_b;
  std::array<scene::PlacedObject, 2> placed;
  Box overlap;
};

/// The pairs of leaves that a walk from beginning to end reaches.
LeafPairs walked_whole(const paper::DualWalk& walk, hierarchy::WalkCounts& counts) {
  std::vector<NodePair> stack;
  LeafPairs leaf_pairs;
  walk.start(stack, counts);
  walk.advance(stack, leaf_pairs, kAll, kAll, counts);
  EXPECT_TRUE(stack.empty());
  return leaf_pairs;
}

/// The triangles that the leaves hold; fails where a pair of them comes twice.
TrianglePairs pairs_of(const LeafPairs& leaf_pairs) {
  TrianglePairs pairs;
  for (const paper::LeafPair& leaves : leaf_pairs)
    for (const std::uint32_t a : leaves.a->triangles)
      for (const std::uint32_t b : leaves.b->triangles) EXPECT_TRUE(pairs.emplace(a, b).second);
  return pairs;
}

/// Only nodes that reach the region have been split.
void expect_split_in_region(paper::ObbTree& tree, const MeshData& mesh, const Pose& pose, const Box& region) {
  std::vector<std::uint32_t> open{paper::ObbTree::kRoot};
  hierarchy::MadeNodes nodes_made;
  while (!open.empty()) {
    const std::uint32_t index = open.back();
    open.pop_back();
    const paper::Node& node = tree.node(index);
    if (!paper::ObbTree::is_split(node)) continue;
    ASSERT_TRUE(paper::may_reach(node.box, pose, rounding_radius(pose, mesh), region));
    const std::uint32_t child = tree.children(index, nodes_made);
    open.insert(open.end(), {child, child + 1});
  }
}

TEST(DualWalk, ReachesEveryPairThatTouchesAtMostOnce) {
  test::Seeded seeded(1);
  std::size_t touching = 0;
  for (const test::NamedScene& named : test::hard_scenes(seeded.random)) {
    SCOPED_TRACE(named.name);
    const std::vector<test::Contact> expected = test::brute_force(named.scene);
    for (const std::uint32_t leaf_size : {1u, 8u}) {
      Walked walked(named.scene, leaf_size);
      ASSERT_TRUE(walked.reached() || expected.empty());
      hierarchy::WalkCounts counts;
      const TrianglePairs found = pairs_of(walked_whole(walked.walk(), counts));
      EXPECT_EQ(counts.made.nodes, walked.tree_a.node_count() + walked.tree_b.node_count());
      expect_split_in_region(walked.tree_a, walked.a, walked.pose_a, walked.overlap);
      expect_split_in_region(walked.tree_b, walked.b, walked.pose_b, walked.overlap);
      for (const test::Contact& contact : expected) ASSERT_TRUE(found.contains({contact[2], contact[3]}));
      touching += expected.size();
    }
  }
  EXPECT_GT(touching, 10000u);
}

/// An L's box stands askew and sticks out of its bounds. A long strip passes beneath the bounds through the box. A
/// query makes the nodes that the walk makes, no more.
TEST(DualWalk, SplitsNodesInTheRegionAlone) {
  scenes::MeshData corner = scenes::grid(30, 2, 0.33, [](int i, int) { return i * 0.01; });
  const auto first = static_cast<std::uint32_t>(corner.vertex_count());
  const scenes::MeshData bar = scenes::grid(2, 30, 0.33, [](int, int j) { return j * 0.01; });
  corner.xyz.insert(corner.xyz.end(), bar.xyz.begin(), bar.xyz.end());
  for (const std::uint32_t v : bar.triangles) corner.triangles.push_back(v + first);
  int reached = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    const scenes::MeshData strip = scenes::shifted(scenes::flat_grid(200, 1, 0.32), -32, -0.16, 0.1);
    scenes::PlacedScene scene = scenes::pair_scene(strip, corner);
    const double angle = random.uniform(0.02, 0.1);
    scene.objects[0].pose.R = {std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle), 0, 0, 0, 1};
    scene.objects[0].pose.t = {random.uniform(-2, 2), random.uniform(-0.6, 0), 0};
    Walked walked(scene, 2);
    if (!walked.reached()) continue;
    ++reached;
    hierarchy::WalkCounts counts;
    walked_whole(walked.walk(), counts);
    expect_split_in_region(walked.tree_a, walked.a, walked.pose_a, walked.overlap);
    expect_split_in_region(walked.tree_b, walked.b, walked.pose_b, walked.overlap);
    const std::vector<Mesh> fresh = test::meshes_of(scene, 2);
    const Contacts contacts = collide(fresh[scene.objects[0].mesh], walked.pose_a, fresh[scene.objects[1].mesh],
                                      walked.pose_b, {.threads = 1, .backend = "paper"})
                                  .value();
    EXPECT_EQ(contacts.statistics.nodes_built, counts.made.nodes);
  }
  EXPECT_GT(reached, 40);
}

/// However the walk is cut into slices, and its stack in two, it finds the same leaves. All nodes are split beforehand:
/// a walk holds those that it splits itself against the region, others not.
TEST(DualWalk, MayBeCutIntoSlices) {
  test::Seeded seeded(2);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 30)) {
    SCOPED_TRACE(named.name);
    Walked walked(named.scene, 2);
    const paper::DualWalk walk = walked.walk();
    hierarchy::WalkCounts counts;
    walked_whole(walk, counts);
    const TrianglePairs expected = pairs_of(walked_whole(walk, counts));
    std::vector<std::vector<NodePair>> stacks(1);
    counts = {};
    LeafPairs leaf_pairs;
    walk.start(stacks[0], counts);
    while (!stacks.empty()) {
      std::vector<NodePair> stack = std::move(stacks.back());
      stacks.pop_back();
      const std::size_t most = static_cast<std::size_t>(seeded.random.integer(1, 3));
      const auto tests = static_cast<std::uint64_t>(seeded.random.integer(1, 20));
      const std::size_t leaves_before = leaf_pairs.size();
      const std::uint64_t tests_before = counts.box_tests;
      walk.advance(stack, leaf_pairs, most, tests, counts);
      EXPECT_LE(leaf_pairs.size(), leaves_before + most);
      EXPECT_LE(counts.box_tests, tests_before + tests);
      const auto middle = stack.begin() + static_cast<std::ptrdiff_t>(stack.size() / 2);
      if (middle != stack.begin()) stacks.emplace_back(stack.begin(), middle);
      if (middle != stack.end()) stacks.emplace_back(middle, stack.end());
    }
    EXPECT_EQ(counts.made.nodes, 0u);
    EXPECT_EQ(pairs_of(leaf_pairs), expected);
  }
}

/// The paper's children only for the potential region, kept for the next query.
TEST(Nodes, AreSplitWhereTheOverlapReachesAndKept) {
  const Mesh ball = test::mesh_of(scenes::uv_sphere(64, 64));
  const auto at_distance = [&](double distance) {
    Pose pose;
    pose.t = {distance, 0, 0};
    return collide(ball, {}, ball, pose, {.threads = 1}).value();
  };
  const Contacts apart = at_distance(2.5);
  EXPECT_EQ(apart.statistics.object_pairs, 0u);
  EXPECT_EQ(apart.statistics.nodes_built, 0u);
  const Contacts light = at_distance(1.99);
  EXPECT_FALSE(light.triangles.empty());
  const std::uint64_t built = light.statistics.nodes_built;
  const std::uint64_t all = 2 * ball.triangle_count() / 8;  // about so many nodes has the whole tree
  EXPECT_GT(built, 0u);
  EXPECT_LT(built, all / 4);
  EXPECT_EQ(at_distance(1.99).statistics.nodes_built, 0u);
  const std::uint64_t more = at_distance(0.5).statistics.nodes_built;
  EXPECT_GT(more, 0u);
  const Contacts again = at_distance(1.99);
  EXPECT_EQ(again.statistics.nodes_built, 0u);
  test::expect_same(light, again);
}

/// Two nearly flush plates whose boxes overlap only along a rim: a near miss builds far less than a full tree.
TEST(Nodes, AreFewInANearMiss) {
  const Mesh plate = test::mesh_of(scenes::bumpy_grid(64, 64));
  Pose pose;
  pose.t = {63.9, 0, 0.5};  // over the last column of cells, above its bumps
  const Contacts contacts = collide(plate, {}, plate, pose, {.threads = 1}).value();
  EXPECT_TRUE(contacts.triangles.empty());
  EXPECT_LT(contacts.statistics.nodes_built, plate.triangle_count() / 16);
}

}  // namespace
}  // namespace impinge
