// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/triangle_tree.hpp"

#include <gtest/gtest.h>

#include "scenes/damaged.hpp"
#include "scenes/shapes.hpp"
#include "solid/locate.hpp"
#include "tests/solid/placed.hpp"
#include "tests/solid/plain_winding.hpp"

namespace impinge {
namespace {

struct Sample {
  std::vector<Triangle> triangles;
  std::vector<Vec3> points;  ///< far, near and between
};

Sample sample_of(const scenes::MeshData& mesh, scenes::Random& random) {
  Sample sample;
  sample.triangles = test::world_triangles(test::mesh_of(mesh), {});
  Box box = box_of(sample.triangles.front());
  for (const Triangle& t : sample.triangles) box = {min(box.lo, box_of(t).lo), max(box.hi, box_of(t).hi)};
  const Vec3 size = box.hi - box.lo;
  for (int i = 0; i < 20; ++i) {
    const auto at = [&](double lo, double extent) { return lo + random.uniform(-0.5, 1.5) * extent; };
    sample.points.push_back({at(box.lo.x, size.x), at(box.lo.y, size.y), at(box.lo.z, size.z)});
    const Triangle& t =
        sample.triangles[static_cast<std::size_t>(random.integer(0, static_cast<int>(sample.triangles.size()) - 1))];
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const double height = std::pow(10, random.uniform(-5, -0.5)) * (random.integer(0, 1) == 0 ? 1 : -1);
    if (norm(n) > 0) sample.points.push_back((1.0 / 3) * (t[0] + t[1] + t[2]) + (height * norm(size) / norm(n)) * n);
  }
  return sample;
}

TEST(TriangleTree, WindingNumbersAreThePlainSum) {
  test::Seeded seeded(5);
  double worst = 0;
  for (const scenes::DamagedSolid& solid : scenes::damaged_solids(5)) {
    SCOPED_TRACE(solid.name);
    const Sample sample = sample_of(solid.damaged, seeded.random);
    const solid::TriangleTree tree(sample.triangles);
    for (const Vec3& p : sample.points)
      worst = std::max(worst, std::abs(tree.winding_number(p) - test::plain_winding(sample.triangles, p)));
  }
  EXPECT_LT(worst, 0x1p-6);
  EXPECT_GT(worst, 0);  // clusters did stand for triangles
}

TEST(TriangleTree, WindingNumbersOfClosedMeshesAreThoseOfExactRays) {
  test::Seeded seeded(6);
  for (const scenes::DamagedSolid& solid : scenes::damaged_solids(6)) {
    SCOPED_TRACE(solid.name);
    const Mesh mesh = test::mesh_of(solid.sound);
    const Sample sample = sample_of(solid.sound, seeded.random);
    const solid::TriangleTree tree(sample.triangles);
    for (const Vec3& p : sample.points) {
      const auto exact = solid::winding_number(mesh.state().placed({}), p);
      if (!exact) continue;
      EXPECT_EQ(std::round(tree.winding_number(p)), *exact);
    }
  }
}

TEST(TriangleTree, TheNearestPointIsThatOfAllTriangles) {
  test::Seeded seeded(7);
  for (const scenes::DamagedSolid& solid : scenes::damaged_solids(7)) {
    const Sample sample = sample_of(solid.damaged, seeded.random);
    const solid::TriangleTree tree(sample.triangles);
    for (const Vec3& p : sample.points) {
      const double distance = test::plain_distance(sample.triangles, p);
      const auto nearest = tree.nearest(p, kInfinity);
      ASSERT_TRUE(nearest);
      EXPECT_NEAR(nearest->distance, distance, 1e-12);
      EXPECT_NEAR(norm(nearest->point - p), nearest->distance, 1e-12);
      EXPECT_FALSE(tree.nearest(p, 0.99 * distance - 1e-12));
    }
  }
}

TEST(TriangleTree, TheFreeWayEndsAtTheFirstTriangle) {
  const solid::TriangleTree tree(test::world_triangles(test::mesh_of(scenes::box({0, 0, 0}, {1, 2, 4}, 3)), {}));
  const Vec3 inside{0.3, 0.7, 1.1};
  EXPECT_NEAR(tree.free_way(inside, {1, 0, 0}, 0), 0.7, 1e-12);
  EXPECT_NEAR(tree.free_way(inside, {0, -1, 0}, 0), 0.7, 1e-12);
  EXPECT_NEAR(tree.free_way(inside, {0, 0, 1}, 0), 2.9, 1e-12);
  EXPECT_NEAR(tree.free_way({-1, 0.7, 1.1}, {1, 0, 0}, 0), 1, 1e-12);
  EXPECT_NEAR(tree.free_way({-1, 0.7, 1.1}, {1, 0, 0}, 1.5), 2, 1e-12);  // the second wall
  EXPECT_EQ(tree.free_way({-1, 0.7, 1.1}, {-1, 0, 0}, 0), kInfinity);
  EXPECT_EQ(solid::TriangleTree({}).free_way(inside, {1, 0, 0}, 0), kInfinity);
  EXPECT_EQ(solid::TriangleTree({}).winding_number(inside), 0);
  EXPECT_FALSE(solid::TriangleTree({}).nearest(inside, kInfinity));
}

}  // namespace
}  // namespace impinge
