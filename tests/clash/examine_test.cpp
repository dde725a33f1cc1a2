// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "impinge/clash.hpp"

namespace impinge {
namespace {

Result<PartFacts> examined(const std::vector<double>& xyz, const std::vector<std::uint32_t>& triangles,
                           const Pose& pose = {}) {
  return examine(Mesh::create(std::span<const double>(xyz), triangles).value(), pose);
}
PartFacts inspected(const std::vector<double>& xyz, const std::vector<std::uint32_t>& triangles,
                    const Pose& pose = {}) {
  return examined(xyz, triangles, pose).value();
}
bool in_domain(const std::vector<double>& xyz) {
  const auto facts = examined(xyz, {0, 1, 2});
  EXPECT_TRUE(facts || facts.error().code == Code::out_of_range);
  return facts.has_value();
}

const std::vector<double> kTetrahedron{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<std::uint32_t> kOutward{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

TEST(Examine, CountsOpenEdgesAndDegenerateTriangles) {
  struct Case {
    const char* what;
    std::vector<std::uint32_t> triangles;
    bool closed;
    std::uint64_t open_edges, degenerate;
  };
  const std::vector<Case> cases{
      {"a tetrahedron", kOutward, true, 0, 0},
      {"a triangle missing", {0, 2, 1, 0, 1, 3, 1, 2, 3}, false, 3, 0},
      {"a triangle turned", {0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3}, false, 3, 0},
      {"a triangle twice", {0, 2, 1, 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, false, 3, 0},
      {"two equal corners, and three", {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 0, 1, 2, 2, 2}, true, 0, 2},
      {"three in a line, a sliver that nobody closes", {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 1, 4}, false, 3, 1},
      {"no area", {0, 0, 1}, false, 0, 1},
      {"no triangles", {}, false, 0, 0},
  };
  std::vector<double> xyz = kTetrahedron;
  xyz.insert(xyz.end(), {0.5, 0, 0});
  for (const Case& each : cases) {
    SCOPED_TRACE(each.what);
    const PartFacts facts = inspected(xyz, each.triangles);
    EXPECT_EQ(facts.closed, each.closed);
    EXPECT_EQ(facts.open_edges, each.open_edges);
    EXPECT_EQ(facts.degenerate, each.degenerate);
  }
  EXPECT_FALSE(inspected({}, {}).closed);
}

TEST(Examine, CornersAreTheSameByPositionAndMinusZeroIsZero) {
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
  EXPECT_EQ(examined(soup, triangles).error().code, Code::out_of_range);
  soup[0] = 0x1p-300;
  EXPECT_FALSE(inspected(soup, triangles).closed);
}

TEST(Examine, NothingIsSaidOutsideTheDomain) {
  EXPECT_FALSE(in_domain({0x1p300, 0, 0, 1, 0, 0, 0, 1, 0}));
  EXPECT_TRUE(in_domain({0x1.fp299, 0, 0, 1, 0, 0, 0, 0x1p-358, 0}));
  EXPECT_FALSE(in_domain({0, 0, 0, 1, 0, 0, 0, 0x1p-359, 0}));
  // A vertex that no triangle uses does not matter.
  EXPECT_TRUE(in_domain({0, 0, 0, 1, 0, 0, 0, 1, 0, 0x1p301, 0, 0}));
}

}  // namespace
}  // namespace impinge
