// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/shapes.hpp"
#include "tests/paper/trees.hpp"

namespace impinge {
namespace {

TEST(ObbTree, CopesWithAMillionCoplanarTriangles) {
  const Mesh plane = test::mesh_of(scenes::flat_grid(708, 708, 1.0 / 3));
  ASSERT_GT(plane.triangle_count(), 1000000u);
  const std::size_t nodes = test::expect_whole_tree(test::numbers_of(plane), 8);
  EXPECT_LT(nodes, plane.triangle_count());
}

TEST(ObbTree, CopesWithAMillionTrianglesInAPoint) {
  scenes::MeshData numbers;
  const std::uint32_t v = numbers.add_vertex(0.1, 0.2, 0.3);
  for (int i = 0; i < 1000000; ++i) numbers.add_triangle(v, v, v);
  const Mesh point = test::mesh_of(numbers);
  test::expect_whole_tree(test::numbers_of(point), 8);
}

/// Two planes of a million triangles that cross along a line: only what lies along the line is built.
TEST(Nodes, AreBuiltAlongTheOverlapAlone) {
  const Mesh plane = test::mesh_of(scenes::flat_grid(708, 708, 1));
  Pose upright;
  upright.R = {1, 0, 0, 0, 0, -1, 0, 1, 0};
  upright.t = {0, 707.5, -0.25};  // only its lowest row reaches the other's last
  const auto contacts = collide(plane, {}, plane, upright);
  ASSERT_TRUE(contacts);
  EXPECT_FALSE(contacts->triangles.empty());
  EXPECT_LT(contacts->statistics.nodes_built, 20000u);
  EXPECT_EQ(collide(plane, {}, plane, upright)->statistics.nodes_built, 0u);
}

}  // namespace
}  // namespace impinge
