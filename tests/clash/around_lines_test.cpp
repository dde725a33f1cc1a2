// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/around_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "pipeline/mesh_state.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge::clash {
namespace {

/// A flat disc about its hub, moved.
Mesh disc(std::uint32_t sides, double x, const Pose& pose) {
  scenes::MeshData mesh{{x, 0, 0}, {}};
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    mesh.xyz.insert(mesh.xyz.end(), {x + std::cos(angle), std::sin(angle), 0});
    mesh.triangles.insert(mesh.triangles.end(), {0, 1 + i, 1 + (i + 1) % sides});
  }
  return test::mesh_of(scenes::baked(mesh, pose));
}

solid::Part part_of(const Mesh& mesh) {
  solid::Body body = solid::make_body({&mesh.state().data, &mesh.state().wide_tree, {}});
  solid::Topology topology = solid::examine(body);
  return solid::make_part(std::move(body), std::move(topology), false);
}

/// Whatever meets what: all of a side's triangles are gone through.
std::vector<std::uint32_t> expected(const MetSide& side, const Box& box, const std::vector<std::uint32_t>& others) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < side.sheets.ids.size(); ++t) {
    const auto meets = [&](std::uint32_t other) {
      return std::count(side.met[t].begin(), side.met[t].end(), other) > 0;
    };
    if (overlap(box_of(side.triangle(t)), box) && std::any_of(others.begin(), others.end(), meets)) found.push_back(t);
  }
  return found;
}

TEST(AlongEdge, FindsWhatOthersMeetNearABox) {
  test::Seeded seeded(1);
  scenes::Random& random = seeded.random;
  int many = 0;
  for (int turn = 0; turn < 40; ++turn) {
    const Pose pose = scenes::random_motion(random, 10);
    const Mesh mesh_a = disc(30, 0, pose), mesh_b = disc(40, 0.1, pose);
    const solid::Part a = part_of(mesh_a), b = part_of(mesh_b);
    std::vector<TrianglePair> pairs;
    const int one_in = 1 << random.integer(0, 6);
    for (std::uint32_t i = 0; i < 30; ++i)
      for (std::uint32_t j = 0; j < 40; ++j)
        if (random.integer(1, one_in) == 1) pairs.push_back({i, j});
    const std::array<MetSide, 2> sides = sides_of(a, b, pairs, 0);
    AlongEdge along_a(sides[0], sides[1]);
    for (const Uses& uses : edges_of(sides[1])) {
      const Triangle triangle = sides[1].triangle(uses[0] / 3);
      const Vec3 &from = triangle[uses[0] % 3], &to = triangle[(uses[0] % 3 + 1) % 3];
      const Box box{min(from, to), max(from, to)};
      std::vector<std::uint32_t> others = triangles_of(uses);
      EXPECT_EQ(along_a.find(box, others), expected(sides[0], box, others));
      for (std::uint32_t j = 0; j < sides[1].sheets.ids.size(); ++j)
        if (random.integer(1, 4) == 1 && std::count(others.begin(), others.end(), j) == 0) others.push_back(j);
      const std::vector<std::uint32_t> found = along_a.find(box, others);
      EXPECT_EQ(found, expected(sides[0], box, others));
      many += int{found.size() > 5};
    }
  }
  EXPECT_GT(many, 100);
}

}  // namespace
}  // namespace impinge::clash
