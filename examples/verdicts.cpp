// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Verdicts with depth: what the parts of an assembly are to each other, and how deep those that share space do.
//
// The block is a cube of side 1. The shaft, such a cube too, reaches 0.25 into it: the middle of its end is so deep in
// the block. Of the core, which lies within the block from 0.25 to 0.5, the corner (0.5, 0.5, 0.5) is the deepest, 0.5
// from each side. The plate stands flush against the block, and the lamp is far away.
//
// prints: block, shaft: penetrating, 0.25 deep
// prints: block, core: inside, 0.50 deep
// prints: block, plate: touching
#include <algorithm>
#include <array>
#include <cstdio>

#include "shapes.hpp"

int main() {
  const std::array<const char*, 5> names{"block", "shaft", "core", "plate", "lamp"};
  const auto cube = box({0, 0, 0}, {1, 1, 1});
  impinge::Scene scene;
  value_of(scene.add(cube));
  value_of(scene.add(cube, {.t{0.75, 0.125, 0.125}}));
  value_of(scene.add(box({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5})));
  value_of(scene.add(cube, {.t{-1, 0, 0}}));
  value_of(scene.add(cube, {.t{0, 9, 0}}));

  for (const impinge::Clash& clash : value_of(impinge::find_clashes(scene, {.depth_precision = 0.01})).pairs) {
    const auto [a, b] = clash.objects;
    std::printf("%s, %s: %s", names[a], names[b], impinge::name(clash.verdict).data());
    if (clash.overlap_depth) {  // for certain between two bounds, which are at most 1 % apart
      const auto& [a_in_b, b_in_a] = *clash.overlap_depth;
      std::printf(", %.2f deep", std::max(a_in_b.lo + a_in_b.hi, b_in_a.lo + b_in_a.hi) / 2);
    }
    std::printf("\n");
  }
}
