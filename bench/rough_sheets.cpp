// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/rough_sheets.hpp"

#include <cmath>

#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

scenes::MeshData sheet(int n, std::uint64_t seed, double offset, const Pose& pose) {
  constexpr double kRoughness = 0.5;  // of a cell
  const double cell = 1.0 / n;
  scenes::Random random(seed);
  const auto height = [&](int i, int j) {
    const double x = i * cell, y = j * cell;
    return 0.1 * std::sin(5 * x) * std::cos(4 * y) + kRoughness * cell * random.uniform(-1, 1);
  };
  return scenes::baked(scenes::shifted(scenes::grid(n, n, cell, height), offset * cell, offset * cell, 0), pose);
}

}  // namespace

scenes::PlacedScene rough_sheets(int triangles) {
  const int n = static_cast<int>(std::lround(std::sqrt(triangles / 2.0)));
  scenes::Random random(17);
  const Pose turn = scenes::random_motion(random, 1);
  return scenes::pair_scene(sheet(n, 1, 0, turn), sheet(n, 2, 0.37, turn));
}

}  // namespace impinge::bench
