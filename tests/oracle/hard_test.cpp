// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
/// Triangles and numbers that break tests made for well-formed meshes of ordinary size.
#include "scenes/hard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "expected.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"

namespace impinge {
namespace {

using scenes::MeshData;
using scenes::PlacedScene;
using scenes::Random;

/// Exact still, under a motion, and under that motion baked. Returns what there is in it still.
expected::Set expect_exact_in_motion(const PlacedScene& scene, Random& random, double reach = 10) {
  expected::Set still = expected::expect_exact(scene);
  const PlacedScene moved = scenes::moved(scene, scenes::random_motion(random, reach));
  SCOPED_TRACE("in motion");
  const expected::Set set = expected::expect_exact(moved);
  SCOPED_TRACE("baked");
  expected::expect_finds(set, scenes::baked(moved));
  return still;
}

class Hard : public testing::TestWithParam<std::uint64_t> {
 protected:
  Random random_{GetParam()};
  testing::ScopedTrace trace_{__FILE__, __LINE__, "seed " + std::to_string(GetParam())};
};

TEST_P(Hard, TrianglesWithoutArea) {
  for (const int side : {1, 2, 4}) {
    const MeshData flat = scenes::degenerate_soup(random_, 120, side);
    const MeshData proper = scenes::integer_soup(random_, 120, side);
    EXPECT_FALSE(expect_exact_in_motion(scenes::pair_scene(flat, flat), random_).empty());
    expect_exact_in_motion(scenes::pair_scene(flat, proper), random_);
    expect_exact_in_motion(scenes::pair_scene(flat, scenes::degenerate_soup(random_, 120, side)), random_);
  }
}

TEST_P(Hard, AllTrianglesInAPoint) {
  MeshData points;
  for (int i = 0; i < 100; ++i) points.add_triangle({0.5, 0.25, 0, 0.5, 0.25, 0, 0.5, 0.25, 0});
  expect_exact_in_motion(scenes::pair_scene(points, points), random_);
  expect_exact_in_motion(scenes::pair_scene(points, scenes::cube()), random_);
}

TEST_P(Hard, IntegerSoups) {
  for (const int side : {1, 2, 3, 6})
    expect_exact_in_motion(
        scenes::pair_scene(scenes::integer_soup(random_, 150, side), scenes::integer_soup(random_, 150, side)),
        random_);
}

TEST_P(Hard, Slivers) {
  const MeshData slivers = scenes::sliver_soup(random_, 300);
  const MeshData others = scenes::sliver_soup(random_, 300);
  const MeshData soup = scenes::triangle_soup(random_, 300, 0.4);
  EXPECT_FALSE(expect_exact_in_motion(scenes::pair_scene(slivers, soup), random_).empty());
  expect_exact_in_motion(scenes::pair_scene(slivers, others), random_);
  expect_exact_in_motion(scenes::pair_scene(slivers, slivers), random_);
}

TEST_P(Hard, Duplicates) {
  const MeshData once = scenes::triangle_soup(random_, 100, 0.5);
  const MeshData other = scenes::triangle_soup(random_, 100, 0.5);
  const expected::Set single = expected::by_oracle(scenes::pair_scene(once, other));
  const PlacedScene scene = scenes::pair_scene(scenes::with_duplicates(once, 3), scenes::with_duplicates(other, 2));
  EXPECT_EQ(expect_exact_in_motion(scene, random_).size(), 6 * single.size());
  expect_exact_in_motion(scenes::pair_scene(scenes::with_duplicates(once, 3), scenes::with_duplicates(once, 2)),
                         random_);
}

TEST_P(Hard, FarFromTheOrigin) {
  // Offsets of 1e6 in the vertices, in the poses, and in both with the difference small.
  const PlacedScene grids = scenes::shifted_pair(scenes::bumpy_grid(8, 8, 0.1), {0.05, 0, 0});
  expect_exact_in_motion(grids, random_, 1e6);
  expect_exact_in_motion(
      scenes::shifted_pair(scenes::shifted(scenes::bumpy_grid(8, 8, 0.1), 1e6, -1e6, 1e6), {0.05, 0, 0}), random_, 1e6);
  PlacedScene both = scenes::pair_scene(scenes::shifted(scenes::uv_sphere(12, 8), 1e6, 0, 0), scenes::uv_sphere(12, 8));
  both.objects[1].pose = {.R = scenes::random_rotation(random_), .t = {1e6 + 0.5, 0.25, 0}};
  EXPECT_FALSE(expect_exact_in_motion(both, random_, 1e6).empty());
}

TEST_P(Hard, ScalesThatArePowersOfTwoChangeNothing) {
  const auto motion = scenes::random_motion(random_, 4);
  const PlacedScene scene = scenes::moved(scenes::shifted_pair(scenes::bumpy_grid(6, 6), {0.5, 0, 0}), motion);
  const PlacedScene flush = scenes::moved(scenes::cube_pair({1, 0, 0}), motion);
  for (const PlacedScene& unscaled : {scene, flush}) {
    const expected::Set set = expected::expect_exact(unscaled);
    for (const int exponent : {-70, -35, -20, 20, 60}) {
      SCOPED_TRACE("scale 2^" + std::to_string(exponent));
      const double scale = std::ldexp(1.0, exponent);
      PlacedScene scaled = unscaled;
      for (MeshData& mesh : scaled.meshes) mesh = scenes::scaled(mesh, scale, scale, scale);
      for (auto& object : scaled.objects)
        for (double& t : object.pose.t) t *= scale;
      expected::expect_finds(set, scaled);
      expected::expect_finds(set, scenes::baked(scaled));
    }
  }
}

TEST_P(Hard, ScalesAgainstAnOffsetOfOne) {
  for (const int exponent : {-70, -50, -40, -20, 20, 60}) {
    SCOPED_TRACE("scale 2^" + std::to_string(exponent));
    const double s = std::ldexp(1.0, exponent);
    expect_exact_in_motion(scenes::shifted_pair(scenes::scaled(scenes::bumpy_grid(6, 6), s, s, s), {s / 2, 0, 0}),
                           random_, 1);
  }
}

TEST_P(Hard, StretchedMeshes) {
  const MeshData knot = scenes::torus_knot(2, 3, 40, 6);
  for (const auto& [x, y, z] : {std::array{1.0, 1e-6, 1e6}, std::array{1e-9, 1.0, 1.0}, std::array{1.0, 1e12, 1e-12}}) {
    const MeshData stretched = scenes::scaled(knot, x, y, z);
    const PlacedScene scene =
        scenes::pair_scene(stretched, scenes::scaled(scenes::shifted(knot, 0.5, 0.25, 0), x, y, z));
    EXPECT_FALSE(expect_exact_in_motion(scene, random_).empty());
  }
}

TEST_P(Hard, RotationsThatAreOffByNearlyTheLimit) {
  for (int i = 0; i < 2; ++i) {
    PlacedScene scene = scenes::pair_scene(scenes::bumpy_grid(10, 10), scenes::flat_grid(20, 20, 0.5));
    // Far vertices and far translations, so that what Rᵀ misses of the inverse of R counts.
    scene.meshes[0] = scenes::shifted(scene.meshes[0], 1e3, 0, 0);
    scene.objects[0].pose = {.R = scenes::stretched_rotation(random_)};
    scene.objects[1].pose.R = scenes::stretched_rotation(random_);
    // B's grid in the middle of A's: a place of A that lies 0.2 above its plane.
    const MeshData world = scenes::baked(scene.meshes[0], scene.objects[0].pose);
    const MeshData own = scenes::baked(scene.meshes[1], scene.objects[1].pose);
    const std::size_t middle_a = 3 * (5 * 11 + 5), middle_b = 3 * (10 * 21 + 10);
    for (std::size_t k = 0; k < 3; ++k) scene.objects[1].pose.t[k] = world.xyz[middle_a + k] - own.xyz[middle_b + k];
    EXPECT_FALSE(expected::expect_exact(scene).empty());
    // The same motion, a million away.
    for (auto& object : scene.objects) {
      object.pose.t[0] += 1e6;
      object.pose.t[1] -= 1e6;
    }
    expected::expect_exact(scene);
    // One such rotation for flush parts.
    expected::expect_exact(scenes::moved(scenes::cube_pair({1, 0, 0}), {.R = scenes::stretched_rotation(random_)}));
    expected::expect_exact(scenes::moved(scenes::shifted_pair(scenes::bumpy_grid(8, 8), {0.5, 0, 0}),
                                         {.R = scenes::stretched_rotation(random_), .t = {1e6, 1e6, -1e6}}));
  }
}

/// Every coordinate goes to the next double up, down, or stays.
MeshData jiggled(MeshData mesh, Random& random) {
  for (double& x : mesh.xyz) {
    const int step = random.integer(-1, 1);
    x = step == 0 ? x : std::nextafter(x, step * std::numeric_limits<double>::infinity());
  }
  return mesh;
}

TEST_P(Hard, GapsOfOneUlp) {
  const double above = std::nextafter(1.0, 2.0);
  const double below = std::nextafter(1.0, 0.0);
  EXPECT_TRUE(expected::expect_exact(scenes::shifted_pair(scenes::cube(), {above, 0, 0})).empty());
  EXPECT_FALSE(expected::expect_exact(scenes::shifted_pair(scenes::cube(), {below, 0, 0})).empty());
  for (const double shift : {above, 1.0, below}) {
    expect_exact_in_motion(scenes::shifted_pair(scenes::cube(), {shift, 0, 0}), random_);
    expect_exact_in_motion(scenes::shifted_pair(scenes::cube(), {shift, shift, 1 - shift}), random_);
  }
  for (const PlacedScene& scene : {scenes::cube_pair({1, 0, 0}), scenes::cube_pair({0, 0, 0}), scenes::t_junctions(3),
                                   scenes::shifted_pair(scenes::bumpy_grid(6, 6), {1, 0, 0})}) {
    PlacedScene turned = scenes::baked(scenes::moved(scene, scenes::random_motion(random_, 1)));
    for (MeshData& mesh : turned.meshes) mesh = jiggled(mesh, random_);
    expect_exact_in_motion(turned, random_);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Hard, testing::Range<std::uint64_t>(1, 3));

TEST(Crowd, ManyObjectsWithGroups) {
  Random random(7);
  PlacedScene scene = scenes::scattered(random, scenes::uv_sphere(8, 6), 60, 6);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) scene.objects[i].group = static_cast<std::uint32_t>(i % 4);
  EXPECT_FALSE(expected::expect_exact(scene).empty());
}

/// Parts that touch without a gap, as CAD's do, still and under rigid motions: where tests in floating point lose most
/// pairs.

/// A cube and a cube whose shift is in its vertices: under a common motion the shared corners stay equal bit for bit.
PlacedScene cubes_sharing_numbers(const std::array<double, 3>& shift) {
  return scenes::shifted_pair(scenes::cube(), shift);
}

std::vector<std::pair<std::string, PlacedScene>> families() {
  using scenes::bumpy_grid, scenes::flat_grid, scenes::shifted_pair;
  std::vector<std::pair<std::string, PlacedScene>> result;
  const std::vector<std::pair<std::string, std::array<double, 3>>> shifts{
      {"face to face", {1, 0, 0}}, {"edge to edge", {1, 1, 0}},          {"vertex to vertex", {1, 1, 1}},
      {"identical", {0, 0, 0}},    {"face on half a face", {1, 0.5, 0}}, {"edge on a face", {0.5, 0.5, 1}}};
  for (const auto& [name, shift] : shifts) {
    result.emplace_back("cubes " + name + ", shifted by pose", scenes::cube_pair(shift));
    result.emplace_back("cubes " + name + ", shifted by vertices", cubes_sharing_numbers(shift));
  }
  const std::vector<std::pair<std::string, scenes::MeshData>> grids{{"flat", flat_grid(8, 8)},
                                                                    {"bumpy", bumpy_grid(8, 8)}};
  for (const auto& [name, grid] : grids) {
    result.emplace_back(name + " grid on itself", shifted_pair(grid, {0, 0, 0}));
    result.emplace_back(name + " grid shifted by a cell", shifted_pair(grid, {1, 0, 0}));
    result.emplace_back(name + " grid shifted by half a cell", shifted_pair(grid, {0.5, 0, 0}));
    result.emplace_back(name + " grid shifted by half a cell both ways", shifted_pair(grid, {0.5, 0.5, 0}));
    result.emplace_back(name + " grid beside itself", shifted_pair(grid, {8, 0, 0}));
    PlacedScene by_pose = shifted_pair(grid, {0, 0, 0});
    by_pose.objects[1].pose.t = {1, 0, 0};
    result.emplace_back(name + " grid shifted by a cell by pose", by_pose);
  }
  result.emplace_back("T-junctions", scenes::t_junctions(4));
  result.emplace_back("boxes of many cells",
                      scenes::pair_scene(scenes::box({0, 0, 0}, {1, 1, 1}, 4), scenes::box({1, 0, 0}, {2, 1, 1}, 3)));
  result.emplace_back("lattice of boxes", scenes::flush_boxes(3, 2, 2));
  result.emplace_back("row of pipes", scenes::pipe_row(5, 12));
  return result;
}

TEST(Flush, StandsStill) {
  for (const auto& [name, scene] : families()) {
    SCOPED_TRACE(name);
    EXPECT_FALSE(expected::expect_exact(scene).empty());
  }
}

/// All families in one scene, in a row in which this one stands at the origin.
PlacedScene row_of_families(std::size_t at_origin) {
  constexpr double kApart = 32;  // more than the largest is long
  PlacedScene row;
  double x = -kApart * static_cast<double>(at_origin);
  for (const auto& [name, scene] : families()) {
    const auto first_mesh = static_cast<std::uint32_t>(row.meshes.size());
    row.meshes.insert(row.meshes.end(), scene.meshes.begin(), scene.meshes.end());
    for (scenes::PlacedObject object : scene.objects) {
      object.mesh += first_mesh, object.pose.t[0] += x;
      row.objects.push_back(object);
    }
    x += kApart;
  }
  return row;
}

/// One common motion of all objects; then the same world vertices baked into meshes, which must not change the answer.
TEST(Flush, ExactInMotionAsPosesAndBaked) {
  for (std::size_t at_origin = 0; at_origin < families().size(); ++at_origin) {
    SCOPED_TRACE("motion of seed " + std::to_string(at_origin + 1));
    Random random(at_origin + 1);
    const PlacedScene moved = scenes::moved(row_of_families(at_origin), scenes::random_motion(random, 10));
    const expected::Set set = expected::expect_exact(moved);
    SCOPED_TRACE("baked");
    expected::expect_finds(set, scenes::baked(moved));
  }
}

TEST(Flush, SurfacesOnThemselvesKeepTheirCommonCornersInMotion) {
  // Whatever the rounding, triangles that share a vertex index share a point.
  Random random(5);
  const PlacedScene scene =
      scenes::moved(scenes::shifted_pair(scenes::bumpy_grid(12, 12), {0, 0, 0}), scenes::random_motion(random, 1e3));
  const auto& index = scene.meshes[0].triangles;
  const expected::Set found = expected::by_scene(scene);
  std::size_t at = 0;
  for (std::uint32_t a = 0; a < index.size() / 3; ++a)
    for (std::uint32_t b = 0; b < index.size() / 3; ++b) {
      const auto of_a = index.begin() + 3 * a;
      if (std::find_first_of(of_a, of_a + 3, index.begin() + 3 * b, index.begin() + 3 * b + 3) == of_a + 3) continue;
      while (at < found.size() && (found[at][2] < a || (found[at][2] == a && found[at][3] < b))) ++at;
      ASSERT_TRUE(at < found.size() && found[at][2] == a && found[at][3] == b) << "missed " << a << ' ' << b;
    }
}

}  // namespace
}  // namespace impinge
