// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/core/support.hpp"

/// Meshes so different in size, or so few triangles, that numbers in the one's unit mean little in the other's.
namespace impinge {
namespace {

void expect_exact(const scenes::PlacedScene& scene) {
  const std::vector<test::Contact> expected = test::brute_force(scene);
  for (const std::uint32_t leaf_size : {0u, 1u, 256u}) {
    const std::vector<Mesh> meshes = test::meshes_of(scene, leaf_size);
    const auto &a = scene.objects[0], &b = scene.objects[1];
    for (const char* backend : {"simd", "paper"}) {
      SCOPED_TRACE(std::string(backend) + ", leaf size " + std::to_string(leaf_size));
      const auto ab = collide(meshes[a.mesh], a.pose, meshes[b.mesh], b.pose, {.backend = backend});
      const auto ba = collide(meshes[b.mesh], b.pose, meshes[a.mesh], a.pose, {.backend = backend});
      ASSERT_TRUE(ab && ba);
      ASSERT_EQ(test::listed(*ab), expected);
      ASSERT_EQ(test::listed(*ba), test::transposed(expected));
      ASSERT_EQ(ab->hash, ba->hash);
      const auto first =
          collide(meshes[a.mesh], a.pose, meshes[b.mesh], b.pose, {.find = Options::Find::first, .backend = backend});
      ASSERT_TRUE(first);
      ASSERT_EQ(first->triangles.size(), expected.empty() ? 0u : 1u);
    }
  }
}

/// Integer triangles about the origin, so that scaled copies still share points there, on edges and inside too.
scenes::MeshData about_origin(scenes::Random& random, int n, int reach, double scale) {
  const double shift = -reach;
  return scenes::scaled(scenes::shifted(scenes::integer_soup(random, n, 2 * reach), shift, shift, shift), scale, scale,
                        scale);
}

TEST(Units, MayDifferByAnyPower) {
  std::size_t touching = 0;
  for (const int exponent : {1, 30, 60, 149, 150, 200, 300}) {
    SCOPED_TRACE(exponent);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      test::Seeded seeded(seed);
      const double small = std::ldexp(1.0, -exponent);
      const scenes::PlacedScene scene =
          scenes::pair_scene(about_origin(seeded.random, 60, 2, 1), about_origin(seeded.random, 40, 1, small));
      touching += test::brute_force(scene).size();
      ASSERT_NO_FATAL_FAILURE(expect_exact(scene));
    }
  }
  EXPECT_GT(touching, 1000u);
}

/// The larger of the two at the top of the domain, the smaller at its bottom: 2^298 and 2^-358 times a few units.
TEST(Units, MayLieAtBothEndsOfTheDomain) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    test::Seeded seeded(seed);
    for (const auto& [large, small] : {std::pair{0x1p298, 0x1p-358}, {0x1p298, 1.0}, {1.0, 0x1p-358}}) {
      ASSERT_NO_FATAL_FAILURE(expect_exact(
          scenes::pair_scene(about_origin(seeded.random, 50, 2, large), about_origin(seeded.random, 30, 1, small))));
      // A mesh that holds both sizes itself.
      scenes::MeshData both = about_origin(seeded.random, 30, 2, large);
      const scenes::MeshData tiny = about_origin(seeded.random, 30, 1, small);
      const auto first = static_cast<std::uint32_t>(both.vertex_count());
      both.xyz.insert(both.xyz.end(), tiny.xyz.begin(), tiny.xyz.end());
      for (const std::uint32_t v : tiny.triangles) both.triangles.push_back(first + v);
      ASSERT_NO_FATAL_FAILURE(expect_exact(scenes::pair_scene(both, tiny)));
      ASSERT_NO_FATAL_FAILURE(expect_exact(scenes::pair_scene(both, both)));
    }
  }
}

/// Far away, where world vertices are rounded to what is coarser than the smaller mesh.
TEST(Units, OfASmallMeshMayVanishInTheWorldsRounding) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    test::Seeded seeded(seed);
    const double small = std::ldexp(1.0, -seeded.random.integer(20, 70));
    scenes::PlacedScene scene =
        scenes::pair_scene(about_origin(seeded.random, 40, 2, 1), about_origin(seeded.random, 40, 1, small));
    for (auto& object : scene.objects) {
      object.pose = scenes::random_motion(seeded.random, 1e6);
      if (seed % 2 == 0) object.pose.R = scenes::stretched_rotation(seeded.random);
      object.pose.t = scene.objects[0].pose.t;
    }
    ASSERT_NO_FATAL_FAILURE(expect_exact(scene));
    for (auto& object : scene.objects)
      for (double& t : object.pose.t) t *= 1e9;
    ASSERT_NO_FATAL_FAILURE(expect_exact(scene));
  }
}

TEST(Units, OfSingleTrianglesPointsAndSegments) {
  std::size_t touching = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    test::Seeded seeded(seed);
    const auto one = [&](double scale) {
      scenes::MeshData mesh = about_origin(seeded.random, 1, 1, scale);
      const int kind = seeded.random.integer(0, 5);
      if (kind == 0) mesh.triangles[2] = mesh.triangles[1];
      if (kind == 1) mesh.triangles[2] = mesh.triangles[1] = mesh.triangles[0];
      return mesh;
    };
    scenes::PlacedScene scene = scenes::pair_scene(one(1), one(std::ldexp(1.0, -seeded.random.integer(0, 2) * 40)));
    if (seed % 2 == 0) scene = scenes::moved(scene, scenes::random_motion(seeded.random, seed % 4 == 0 ? 1e6 : 0));
    touching += test::brute_force(scene).size();
    ASSERT_NO_FATAL_FAILURE(expect_exact(scene));
  }
  EXPECT_GT(touching, 50u);
}

TEST(Units, OfMeshesWithoutTrianglesMatterToNobody) {
  scenes::MeshData lone;
  lone.add_vertex(0, 0, 0);
  for (const scenes::MeshData& empty : {scenes::MeshData{}, lone})
    for (const scenes::MeshData& other : {scenes::cube(), empty}) {
      ASSERT_NO_FATAL_FAILURE(expect_exact(scenes::pair_scene(empty, other)));
      EXPECT_TRUE(test::brute_force(scenes::pair_scene(empty, other)).empty());
    }
}

}  // namespace
}  // namespace impinge
