// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "surface.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace impinge::cli {
namespace {

Surface inspected(const std::vector<double>& xyz, const std::vector<std::uint32_t>& triangles, const Pose& pose = {}) {
  return inspect(Mesh::create(std::span<const double>(xyz), triangles).value(), pose);
}

const std::vector<double> kTetrahedron{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<std::uint32_t> kOutward{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

TEST(Surface, ATetrahedronIsClosed) {
  const Surface surface = inspected(kTetrahedron, kOutward);
  EXPECT_TRUE(surface.closed);
  EXPECT_EQ(surface.open_edges, 0U);
  EXPECT_EQ(surface.degenerate, 0U);
}

TEST(Surface, AMissingTriangleOpensItsThreeEdges) {
  const Surface surface = inspected(kTetrahedron, {0, 2, 1, 0, 1, 3, 1, 2, 3});
  EXPECT_FALSE(surface.closed);
  EXPECT_EQ(surface.open_edges, 3U);
}

TEST(Surface, ATurnedTriangleOpensItsThreeEdges) {
  EXPECT_EQ(inspected(kTetrahedron, {0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3}).open_edges, 3U);
}

TEST(Surface, ADuplicateTriangleOpensItsThreeEdges) {
  EXPECT_EQ(inspected(kTetrahedron, {0, 2, 1, 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}).open_edges, 3U);
}

TEST(Surface, CornersAreTheSameByPositionAndMinusZeroIsZero) {
  // No two triangles share an index.
  std::vector<double> soup;
  std::vector<std::uint32_t> triangles;
  for (const std::uint32_t v : kOutward) {
    triangles.push_back(static_cast<std::uint32_t>(triangles.size()));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = kTetrahedron[3 * v + axis];
      soup.push_back(value == 0 && triangles.size() % 2 == 0 ? -0.0 : value);
    }
  }
  EXPECT_TRUE(inspected(soup, triangles).closed);
  soup[0] = 5e-324;
  EXPECT_FALSE(inspected(soup, triangles).in_domain);
  soup[0] = 0x1p-300;
  EXPECT_FALSE(inspected(soup, triangles).closed);
}

TEST(Surface, TwoEqualCornersOpenNothingAndThreeInALineCountAsTheyAre) {
  std::vector<std::uint32_t> triangles = kOutward;
  triangles.insert(triangles.end(), {0, 0, 1, 2, 2, 2});
  const Surface surface = inspected(kTetrahedron, triangles);
  EXPECT_TRUE(surface.closed);
  EXPECT_EQ(surface.degenerate, 2U);
  // (0,0,0), (1,0,0) and (0.5,0,0): a sliver that nobody closes.
  std::vector<double> xyz = kTetrahedron;
  xyz.insert(xyz.end(), {0.5, 0, 0});
  triangles = kOutward;
  triangles.insert(triangles.end(), {0, 1, 4});
  const Surface sliver = inspected(xyz, triangles);
  EXPECT_EQ(sliver.degenerate, 1U);
  EXPECT_EQ(sliver.open_edges, 3U);
}

TEST(Surface, WithoutAnAreaNothingIsClosed) {
  EXPECT_FALSE(inspected(kTetrahedron, {0, 0, 1}).closed);
  EXPECT_FALSE(inspected(kTetrahedron, {}).closed);
  EXPECT_FALSE(inspected({}, {}).closed);
}

TEST(Surface, IsJudgedInTheWorld) {
  // A shift of 2^53 rounds the corners of a unit triangle onto a line.
  Pose far;
  far.t = {0, 0x1p60, 0};
  EXPECT_EQ(inspected(kTetrahedron, {0, 1, 2}).degenerate, 0U);
  EXPECT_EQ(inspected(kTetrahedron, {0, 1, 2}, far).degenerate, 1U);
}

TEST(Surface, NothingIsSaidOutsideTheDomain) {
  EXPECT_FALSE(inspected({0x1p300, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}).in_domain);
  EXPECT_TRUE(inspected({0x1.fp299, 0, 0, 1, 0, 0, 0, 0x1p-358, 0}, {0, 1, 2}).in_domain);
  EXPECT_FALSE(inspected({0, 0, 0, 1, 0, 0, 0, 0x1p-359, 0}, {0, 1, 2}).in_domain);
  // A vertex that no triangle uses does not matter.
  EXPECT_TRUE(inspected({0, 0, 0, 1, 0, 0, 0, 1, 0, 0x1p301, 0, 0}, {0, 1, 2}).in_domain);
}

}  // namespace
}  // namespace impinge::cli
