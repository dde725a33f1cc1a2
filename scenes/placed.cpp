// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/placed.hpp"

#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"

namespace impinge::scenes {

PlacedScene cube_pair(const std::array<double, 3>& shift) {
  PlacedScene scene;
  scene.meshes = {cube()};
  scene.objects = {{.mesh = 0}, {.mesh = 0, .pose = {.t = shift}}};
  return scene;
}

PlacedScene shifted_pair(const MeshData& mesh, const std::array<double, 3>& shift) {
  return pair_scene(mesh, shifted(mesh, shift[0], shift[1], shift[2]));
}

PlacedScene t_junctions(int n) {
  // Thirds are not doubles: the coarse grid has cells of 3, the fine one of 1.
  MeshData coarse = flat_grid(n, n, 3);
  const MeshData upright = baked(flat_grid(n, n, 3), {.R = {1, 0, 0, 0, 0, -1, 0, 1, 0}});
  const auto offset = static_cast<std::uint32_t>(coarse.vertex_count());
  coarse.xyz.insert(coarse.xyz.end(), upright.xyz.begin(), upright.xyz.end());
  for (const std::uint32_t v : upright.triangles) {
    coarse.triangles.push_back(v + offset);
  }
  return pair_scene(coarse, flat_grid(3 * n, 3 * n, 1));
}

PlacedScene flush_boxes(int nx, int ny, int nz) {
  PlacedScene scene;
  scene.meshes = {cube()};
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      for (int k = 0; k < nz; ++k) {
        const std::array<double, 3> t{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        scene.objects.push_back({.mesh = 0, .pose = {.t = t}});
      }
    }
  }
  return scene;
}

PlacedScene ten_thousand_flush_boxes() { return flush_boxes(25, 20, 20); }

PlacedScene pipe_row(int n, int around) {
  PlacedScene scene;
  scene.meshes = {pipe(around, 1, 0.5, 1, false)};
  for (int i = 0; i < n; ++i) {
    scene.objects.push_back(
        {.mesh = 0, .pose = {.R = {0, 0, 1, 1, 0, 0, 0, 1, 0}, .t = {static_cast<double>(i), 0, 0}}});
  }
  return scene;
}

PlacedScene scattered(Random& random, const MeshData& mesh, int n, double side) {
  PlacedScene scene;
  scene.meshes = {mesh};
  for (int i = 0; i < n; ++i) {
    scene.objects.push_back({.mesh = 0, .pose = random_motion(random, side / 2)});
  }
  return scene;
}

}  // namespace impinge::scenes
