// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/crowd.hpp"

#include <cmath>
#include <numbers>

#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

constexpr double kSize = 6.8;  // a torus knot's bounding-sphere diameter
constexpr double kStep = 0.01 * kSize, kTurn = std::numbers::pi / 180;

struct Swing {
  std::array<double, 9> axes;  // the body moves along the first column and turns about the second
  double phase;
};

Pose swung(const Pose& rest, const Swing& swing, double angle) {
  // The sine's steepest step is one part of the circle's 2 pi.
  const double reach = Crowd::kFrames / (2 * std::numbers::pi);
  const double out = std::sin(angle + swing.phase), turn = kTurn * reach * out;
  const auto& axes = swing.axes;
  // The rotation about the second column by `turn`, in the basis of the columns.
  const double c = std::cos(turn), s = std::sin(turn);
  const std::array<double, 9> about{c, 0, s, 0, 1, 0, -s, 0, c};
  Pose pose = rest;
  for (std::size_t i = 0; i < 3; ++i) {
    pose.t[i] += kStep * reach * out * axes[3 * i];
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) sum += axes[3 * i + k] * about[3 * k + l] * rest.R[3 * l + j];
      pose.R[3 * i + j] = sum;
    }
  }
  return pose;
}

}  // namespace

Crowd::Crowd(int bodies) {
  constexpr double kSpacing = 0.85 * kSize, kShake = 0.05 * kSize;
  const int side = static_cast<int>(std::ceil(std::cbrt(bodies)));
  scenes::Random random(static_cast<std::uint64_t>(bodies));
  scene_.meshes = {scenes::torus_knot_of(968)};
  for (int i = 0; i < bodies; ++i) {
    Pose pose = scenes::random_motion(random, kShake);
    for (int k = 0, cell = i; k < 3; ++k, cell /= side) pose.t[static_cast<std::size_t>(k)] += kSpacing * (cell % side);
    scene_.objects.push_back({.mesh = 0, .pose = pose});
  }
  std::vector<Swing> swings;
  for (int i = 0; i < bodies; ++i)
    swings.push_back({scenes::random_rotation(random), random.uniform(0, 2 * std::numbers::pi)});
  for (std::size_t f = 0; f < kFrames; ++f) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(f) / kFrames;
    frames_.emplace_back();
    for (std::size_t i = 0; i < swings.size(); ++i)
      frames_.back().push_back(swung(scene_.objects[i].pose, swings[i], angle));
  }
}

}  // namespace impinge::bench
