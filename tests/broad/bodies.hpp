// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "broad/may_touch.hpp"
#include "broad/near_pairs.hpp"
#include "broad/object_pairs.hpp"
#include "scene/scene_view.hpp"

/// Objects that are only bounds, as the broad phase sees them.
namespace impinge::test {

inline const MeshData kSomething;  ///< the broad phase only asks whether there is a mesh

/// The sphere is around the box.
inline scene::PlacedObject box_at(const Vec3& center, const Vec3& half, std::uint32_t group = 0) {
  scene::PlacedObject object;
  object.mesh = &kSomething;
  object.group = group;
  object.sphere = {center, norm(half) * (1 + 1e-12)};
  object.box = {center - half, center + half};
  return object;
}

/// A frame: every object is placed where it is now, those that are no more included.
inline void update(broad::NearPairs& near_pairs, const std::vector<scene::PlacedObject>& objects) {
  near_pairs.reserve(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i) near_pairs.place(i, objects[i]);
  near_pairs.update();
}

inline broad::ObjectPairs pairs_of(const broad::NearPairs& near_pairs, const scene::SceneView& view) {
  broad::ObjectPairs pairs(1, {7, 7});  // what was there before must go
  broad::NearPairs::Scratch scratch{{7}, {{7}, 7, {7}}};
  near_pairs.find(view, pairs, scratch);
  return pairs;
}

/// By brute force: what the broad phase is held against.
inline broad::ObjectPairs all_pairs(const scene::SceneView& view) {
  broad::ObjectPairs pairs;
  const auto n = static_cast<std::uint32_t>(view.objects.size());
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a + 1; b < n; ++b)
      if (broad::may_touch(view, a, b)) pairs.push_back({a, b});
  return pairs;
}

/// Unit boxes that fill a lattice.
inline std::vector<scene::PlacedObject> lattice(int nx, int ny, int nz) {
  std::vector<scene::PlacedObject> objects;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) objects.push_back(box_at({1.0 * i, 1.0 * j, 1.0 * k}, {0.5, 0.5, 0.5}));
  return objects;
}

/// Each box and its neighbours, itself among them: 3n - 2 of both along an axis.
inline std::size_t lattice_pairs(std::size_t nx, std::size_t ny, std::size_t nz) {
  return ((3 * nx - 2) * (3 * ny - 2) * (3 * nz - 2) - nx * ny * nz) / 2;
}

/// `n` pipes as long as the cube that they fill, a third along each axis. Beside each other at a distance of 1 in both
/// directions, and between those of the other axes: none touch.
inline std::vector<scene::PlacedObject> pipes_along_three_axes(int n) {
  const int side = static_cast<int>(std::sqrt(n / 3.0));
  const double half = 0.5 * side;
  std::vector<scene::PlacedObject> objects;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      objects.push_back(box_at({0, i - half, j - half}, {half, 0.05, 0.05}));
      objects.push_back(box_at({i - half + 0.4, 0, j - half + 0.33}, {0.05, half, 0.05}));
      objects.push_back(box_at({i - half + 0.7, j - half + 0.5, 0}, {0.05, 0.05, half}));
    }
  return objects;
}

}  // namespace impinge::test
