// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"

namespace impinge::test {

/// A crowd of everything: flush boxes, soups of every kind, one large pair that threads share.
inline scenes::PlacedScene crowd(std::uint64_t seed) {
  scenes::Random random(seed);
  scenes::PlacedScene scene = scenes::flush_boxes(3, 2, 2);
  const auto add = [&](scenes::MeshData mesh, const Pose& pose) {
    scene.objects.push_back({.mesh = static_cast<std::uint32_t>(scene.meshes.size()), .pose = pose});
    scene.meshes.push_back(std::move(mesh));
  };
  add(scenes::integer_soup(random, 60, 3), {});
  add(scenes::degenerate_soup(random, 60, 3), {});
  add(scenes::sliver_soup(random, 60), scenes::random_motion(random, 1));
  add(scenes::with_duplicates(scenes::triangle_soup(random, 40, 1), 2), scenes::random_motion(random, 1));
  add(scenes::torus_knot_of(968), {});
  add(scenes::torus_knot_of(968), scenes::random_motion(random, 0.5));
  add(scenes::bumpy_grid(16, 16, 0.25), {});
  return scene;
}

}  // namespace impinge::test
