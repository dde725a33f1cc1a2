// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scenes/hard.hpp"
#include "scenes/shapes.hpp"
#include "tests/paper/trees.hpp"

namespace impinge {
namespace {

void expect_whole_trees(const scenes::MeshData& numbers) {
  const Mesh mesh = test::mesh_of(numbers);
  for (const std::uint32_t leaf_size : {1u, 2u, 7u, 8u, 64u, 255u, 256u}) {
    SCOPED_TRACE("leaf size " + std::to_string(leaf_size));
    test::expect_whole_tree(test::numbers_of(mesh), leaf_size);
  }
}

TEST(ObbTree, HasEachTriangleInOneLeaf) {
  test::Seeded seeded(1);
  expect_whole_trees(scenes::uv_sphere(20, 20));
  expect_whole_trees(scenes::triangle_soup(seeded.random, 700, 0.1));
  expect_whole_trees(scenes::integer_soup(seeded.random, 700, 2));
  expect_whole_trees(scenes::degenerate_soup(seeded.random, 700, 2));
  expect_whole_trees(scenes::cube());
}

TEST(ObbTree, CopesWithAllTrianglesInAPoint) {
  scenes::MeshData points;
  for (int i = 0; i < 3000; ++i) points.add_triangle({0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 0.1, 0.2, 0.3});
  expect_whole_trees(points);
  scenes::MeshData one;
  const std::uint32_t v = one.add_vertex(1e6, 1e-6, 0.3);
  for (int i = 0; i < 3000; ++i) one.add_triangle(v, v, v);
  expect_whole_trees(one);
  expect_whole_trees(scenes::with_duplicates(scenes::cube(), 200));
}

TEST(ObbTree, CopesWithSlivers) {
  test::Seeded seeded(2);
  expect_whole_trees(scenes::sliver_soup(seeded.random, 500));
  expect_whole_trees(scenes::sliver_soup(seeded.random, 500, 1e-300));
}

/// Each split at the mean peels off the largest few.
TEST(ObbTree, CopesWithExponentiallySpacedTriangles) {
  for (const double base : {2.0, 1.05}) {
    scenes::MeshData numbers;
    for (int i = -550; i <= 290; ++i) {
      const double x = std::pow(base, base == 2 ? std::max(i, -300) : i);
      numbers.add_triangle({x, 0, 0, x, x, 0, x, 0, x});
    }
    expect_whole_trees(numbers);
  }
}

TEST(ObbTree, IsMadeForTheDomainsBorders) {
  test::Seeded seeded(3);
  for (const double scale : {0x1p-350, 0x1p-300, 0x1p299})
    expect_whole_trees(scenes::scaled(scenes::triangle_soup(seeded.random, 100, 1), scale, scale, scale));
}

/// A block has each edge of each triangle, knows whose it is, and shares between at most two.
RC_GTEST_PROP(LeafBlock, HasEveryEdgeOfEveryTriangle, ()) {
  const auto n = *rc::gen::inRange<std::size_t>(1, 40);
  const auto indices = *rc::gen::container<std::vector<std::uint32_t>>(3 * n, rc::gen::inRange(0u, 7u));
  std::vector<double> xyz(21);
  for (std::size_t i = 0; i < xyz.size(); ++i) xyz[i] = static_cast<double>(i * i % 11);
  const Mesh mesh = Mesh::create(xyz, indices).value();
  std::vector<std::uint32_t> ids;
  for (std::uint32_t t = 0; t < n; t += 1 + t % 2) ids.push_back(t);
  std::reverse(ids.begin(), ids.end());
  const paper::LeafBlock block = paper::make_leaf_block(test::numbers_of(mesh), ids);

  std::set<std::array<std::uint32_t, 3>> owned;  // triangle and its edge's ends
  for (const paper::LeafEdge& edge : block.edges) {
    const auto [low, high] = std::minmax({block.vertices[edge.from], block.vertices[edge.to]});
    RC_ASSERT(edge.left != paper::LeafEdge::kNone);
    RC_ASSERT(edge.left != edge.right);
    owned.insert({block.triangles[edge.left], low, high});
    if (edge.right != paper::LeafEdge::kNone) owned.insert({block.triangles[edge.right], low, high});
  }
  std::set<std::array<std::uint32_t, 3>> expected;
  for (const std::uint32_t t : ids)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax({indices[3 * t + i], indices[3 * t + (i + 1) % 3]});
      expected.insert({t, low, high});
    }
  RC_ASSERT(owned == expected);
  std::vector<std::uint32_t> sorted = ids;
  std::sort(sorted.begin(), sorted.end());
  RC_ASSERT(block.triangles == sorted);
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) RC_ASSERT(block.vertices[block.corners[i][k]] == indices[3 * sorted[i] + k]);
}

/// In a closed mesh an edge belongs to two triangles: half as many edges go on as triangles have sides.
TEST(LeafBlock, CountsSharedEdgesOnce) {
  const Mesh cube = test::mesh_of(scenes::cube());
  const std::array<std::uint32_t, 12> all{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  EXPECT_EQ(paper::make_leaf_block(test::numbers_of(cube), all).edges.size(), 18u);
}

}  // namespace
}  // namespace impinge
