// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "calibration.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "impinge/collide.hpp"

namespace impinge {
namespace {

/// A closed surface with bumps, so that neither the boxes nor the contacts are of one size. Its coordinates have few
/// digits, as those of most models: how long exact arithmetic takes depends on them.
Mesh bumpy_sphere() {
  constexpr std::uint32_t kRings = 32, kSides = 48;
  std::vector<double> xyz;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t i = 0; i <= kRings; ++i) {
    for (std::uint32_t j = 0; j < kSides; ++j) {
      const double theta = 3.141592653589793 * i / kRings, phi = 6.283185307179586 * j / kSides;
      const double r = 1 + 0.05 * std::sin(7 * theta) * std::cos(5 * phi);
      for (const double x :
           {r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)})
        xyz.push_back(0x1p-12 * std::round(0x1p12 * x));
      if (i == kRings) continue;
      const std::uint32_t right = (j + 1) % kSides;
      const std::uint32_t a = i * kSides + j, b = i * kSides + right, c = a + kSides, d = b + kSides;
      triangles.insert(triangles.end(), {a, c, b, b, c, d});
    }
  }
  return Mesh::create(std::span<const double>(xyz), triangles).value();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

schedule::CostConstants calibrate(std::string_view backend) {
  constexpr int kRounds = 5;
  std::vector<double> box_test, element_test, node, leaf_pair, exact_call;
  Pose pose;
  pose.t = {1.2, 0.3, 0.1};
  const Options one_thread{.threads = 1, .backend = backend};
  for (int round = 0; round < kRounds; ++round) {
    const Mesh mesh = bumpy_sphere();  // anew, so that its tree is made anew
    const Statistics building = collide(mesh, {}, mesh, pose, one_thread).value().statistics;
    const Statistics repeated = collide(mesh, {}, mesh, pose, one_thread).value().statistics;
    const Statistics touching = collide(mesh, {}, mesh, {}, one_thread).value().statistics;
    const schedule::CostConstants constants = schedule::constants_from(building, repeated, touching);
    box_test.push_back(constants.box_test);
    element_test.push_back(constants.element_test);
    node.push_back(constants.node);
    leaf_pair.push_back(constants.leaf_pair);
    exact_call.push_back(constants.exact_call);
  }
  return {median(box_test), median(element_test), median(node), median(leaf_pair), median(exact_call)};
}

}  // namespace

const schedule::CostConstants& calibrated_constants(std::string_view backend) {
  if (backend == "scalar") {
    static const schedule::CostConstants scalar = calibrate("scalar");
    return scalar;
  }
  if (backend == "raster") {  // on the device that is taken where none is named
    static const schedule::CostConstants raster = calibrate("raster");
    return raster;
  }
  static const schedule::CostConstants simd = calibrate("simd");
  return simd;
}

}  // namespace impinge
