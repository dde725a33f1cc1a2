// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Parts that touch without a gap, as CAD's do, still and under rigid motions: where tests in floating point lose most
/// pairs.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "expected.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"

namespace impinge {
namespace {

using scenes::PlacedScene;
using scenes::Random;

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

/// All families in one scene, in a row.
PlacedScene row_of_families() {
  constexpr double kApart = 32;  // more than the largest is long
  PlacedScene row;
  double x = 0;
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
  const PlacedScene row = row_of_families();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("motion of seed " + std::to_string(seed));
    Random random(seed);
    const PlacedScene moved = scenes::moved(row, scenes::random_motion(random, 10));
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
  for (std::uint32_t a = 0; a < index.size() / 3; ++a) {
    for (std::uint32_t b = 0; b < index.size() / 3; ++b) {
      const auto of_a = index.begin() + 3 * a;
      if (std::find_first_of(of_a, of_a + 3, index.begin() + 3 * b, index.begin() + 3 * b + 3) == of_a + 3) {
        continue;
      }
      while (at < found.size() && (found[at][2] < a || (found[at][2] == a && found[at][3] < b))) {
        ++at;
      }
      ASSERT_TRUE(at < found.size() && found[at][2] == a && found[at][3] == b) << "missed " << a << ' ' << b;
    }
  }
}

}  // namespace
}  // namespace impinge
