// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measure/nearest.hpp"
#include "pipeline/mesh_state.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
#include "tests/measure/exact_distance.hpp"

namespace impinge {
namespace {

void expect_nearest(const Mesh& mesh, const Pose& pose, const std::vector<Triangle>& world, const Vec3& p) {
  oracle::Least least;
  for (const Triangle& t : world) least.offer(oracle::square_distance({p, p, p}, t));
  const hierarchy::PlacedTree placed{&mesh.state().data, &mesh.state().wide_tree, pose};
  const auto found = measure::nearest_point(placed, p, kInfinity);
  ASSERT_TRUE(found);
  EXPECT_TRUE(oracle::is_within(least.value(), found->distance, found->error))
      << found->distance << " +- " << found->error << ", not " << std::sqrt(least.value().get_d());
  EXPECT_EQ(found->distance == 0, least.value() == 0);
  EXPECT_TRUE(
      oracle::is_within(oracle::square_distance({p, p, p}, world[found->triangle]), found->distance, found->error));
  double size = 0;
  for (const Triangle& t : world)
    for (const Vec3& corner : t) size = std::max(size, max_component(abs(corner - p)));
  EXPECT_LE(found->error, 0x1p-33 * size);
  const Vec3& q = found->point;
  EXPECT_TRUE(oracle::is_within(oracle::square_distance({q, q, q}, world[found->triangle]), 0,
                                0x1p-44 * size + 0x1p-50 * max_component(abs(q))));
  EXPECT_TRUE(measure::nearest_point(placed, p, found->distance + 2 * found->error));
  if (found->distance > 4 * found->error) {
    EXPECT_FALSE(measure::nearest_point(placed, p, found->distance - 2 * found->error));
  }
  const auto quick = measure::nearest_point(placed, p, kInfinity, 2 * found->distance);
  ASSERT_TRUE(quick);
  EXPECT_LE(quick->distance, 2 * found->distance);
  const double within = 2 * found->distance + 2 * found->error;
  std::vector<std::uint32_t> near;
  measure::near_triangles(placed, p, within, [&](std::uint32_t t) { near.push_back(t); });
  std::sort(near.begin(), near.end());
  EXPECT_TRUE(std::adjacent_find(near.begin(), near.end()) == near.end());
  for (std::uint32_t t = 0; t < world.size(); ++t)
    if (oracle::is_within(oracle::square_distance({p, p, p}, world[t]), 0, within)) {
      EXPECT_TRUE(std::binary_search(near.begin(), near.end(), t));
    }
}

TEST(NearestPoint, IsTheExactOneOfHardScenes) {
  test::Seeded seeded(4);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 20)) {
    SCOPED_TRACE(named.name);
    const std::vector<Mesh> meshes = test::meshes_of(named.scene, 3);
    const auto& [a, b] = std::pair(named.scene.objects[0], named.scene.objects[1]);
    const auto world = test::world_triangles(meshes[a.mesh], a.pose);
    // Corners of the other, which often touch; points between; and points that are far.
    const auto others = test::world_triangles(meshes[b.mesh], b.pose);
    for (std::size_t i = 0; i < others.size(); i += 3) {
      const Vec3 corner = others[i][0], between = 0.5 * (corner + world[i % world.size()][1]);
      for (const Vec3& p : {corner, between, 3.0 * corner, world[i % world.size()][2]})
        ASSERT_NO_FATAL_FAILURE(expect_nearest(meshes[a.mesh], a.pose, world, p));
    }
  }
}

/// On its own corners a body is at 0, wherever it stands: far from the origin these are rounded to places outside of
/// the tree's boxes, and so is the point where it is brought into a box's frame in single precision.
TEST(NearestPoint, OnTheBodyIsNotPassedOver) {
  test::Seeded seeded(5);
  for (const double away : {0.0, 1.0, 1e3, 1e6, 1e9, 1e12}) {
    SCOPED_TRACE(away);
    const Mesh mesh = test::mesh_of(scenes::triangle_soup(seeded.random, 200, 0.3), 2);
    Pose pose = scenes::random_motion(seeded.random, 1);
    pose.t[0] += away, pose.t[1] -= 0.7 * away;
    const hierarchy::PlacedTree placed{&mesh.state().data, &mesh.state().wide_tree, pose};
    for (const Triangle& triangle : test::world_triangles(mesh, pose)) {
      for (const Vec3& corner : triangle) {
        const auto found = measure::nearest_point(placed, corner, 0);
        ASSERT_TRUE(found) << corner.x << ' ' << corner.y << ' ' << corner.z;
        EXPECT_EQ(found->distance, 0);
      }
    }
  }
}

TEST(NearestPoint, OfAStoppedSearchIsNone) {
  const Mesh mesh = test::mesh_of(scenes::cube());
  std::stop_source source;
  source.request_stop();
  EXPECT_FALSE(measure::nearest_point({&mesh.state().data, &mesh.state().wide_tree, {}}, {0, 0, 0}, kInfinity, 0,
                                      source.get_token()));
}

TEST(NearestPoint, OfNoTriangleIsNone) {
  const Mesh mesh = test::mesh_of({});
  EXPECT_FALSE(measure::nearest_point({&mesh.state().data, &mesh.state().wide_tree, {}}, {0, 0, 0}, kInfinity));
}

}  // namespace
}  // namespace impinge
