// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "core/pose.hpp"

#include <algorithm>
#include <cmath>

#include "core/float_environment.hpp"
#include "scene/validate_pose.hpp"

namespace impinge {
namespace {

std::array<double, 9> entries(const Mat3& m) {
  return {m[0].x, m[0].y, m[0].z, m[1].x, m[1].y, m[1].z, m[2].x, m[2].y, m[2].z};
}

}  // namespace

Result<Pose> Pose::from_quaternion(const Quaternion& rotation, const std::array<double, 3>& t) {
  const FloatEnvironment nearest;
  auto [w, x, y, z] = rotation;
  const double largest = std::max({std::abs(w), std::abs(x), std::abs(y), std::abs(z)});
  const auto is_finite = [](double part) { return std::isfinite(part); };
  if (!(largest > 0) || !is_finite(w) || !is_finite(x) || !is_finite(y) || !is_finite(z))
    return Error{Code::bad_pose, "the quaternion's length is not a finite number above 0; give one that is"};
  // By a power of two near the largest, so that squares neither over- nor underflow.
  const int exponent = std::ilogb(largest);
  for (double* const part : {&w, &x, &y, &z}) *part = std::scalbn(*part, -exponent);
  const double s = 2 / (w * w + x * x + y * y + z * z);
  Pose pose{.R = {1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
                  s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),  //
                  s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)},
            .t = t};
  if (auto valid = scene::validate(pose); !valid) return valid.error();
  return pose;
}

// Newton's iteration X <- (X + X^-T) / 2 (Higham, "Computing the polar decomposition - with applications", 1986): from
// singular values within 0.17 of 1 five steps leave less than 2^-64.
Result<Pose> Pose::nearest(const Affine& map) {
  const FloatEnvironment nearest;
  Pose pose{.R = map.m, .t = map.t};
  if (auto valid = scene::validate(pose, 0.1); !valid) return valid.error();
  Mat3 X = to_mat3(pose.R);
  for (int step = 0; step < 5; ++step) {
    const Mat3 other = transpose(inverse(X));
    for (std::size_t i = 0; i < 3; ++i) X[i] = 0.5 * (X[i] + other[i]);
  }
  pose.R = entries(X);
  return pose;
}

}  // namespace impinge
