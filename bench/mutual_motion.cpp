// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/mutual_motion.hpp"

#include <cmath>
#include <numbers>

namespace impinge::bench {
namespace {

Pose turned(const Point& axis, double angle, const std::array<double, 3>& shift) {
  const double along = std::sin(angle / 2), w = std::hypot(axis.x, axis.y, axis.z) * std::cos(angle / 2);
  return Pose::from_quaternion({w, along * axis.x, along * axis.y, along * axis.z}, shift).value();
}

}  // namespace

std::vector<scenes::PosePair> mutual_motion(int every) {
  constexpr int kSteps = 200;
  std::vector<scenes::PosePair> poses;
  for (int step = 0; step < kSteps; step += every) {
    const double u = static_cast<double>(step) / (kSteps - 1), turn = 2 * std::numbers::pi * u;
    poses.push_back({turned({1, 2, 3}, turn, {0, 0, 0}),
                     turned({-2, 1, 0.5}, 1.5 * turn, {-7.0 + 14.0 * u, 0.6 - 1.1 * u, -0.4 + 1.1 * u})});
  }
  return poses;
}

}  // namespace impinge::bench
