// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/screw.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace impinge::motion {
namespace {

Vec3 to_vec3(const std::array<double, 3>& t) { return {t[0], t[1], t[2]}; }

/// A turn as the axis and the angle, from 0 to pi; the axis is 0 where the angle is.
struct AxisAngle {
  Vec3 axis{0, 0, 0};
  double angle = 0;
};

/// By the quaternion, from its largest part (Shepperd, "Quaternion from rotation matrix", 1978). The turns of equal
/// matrices is 0 exactly: the product is symmetric then, for its entries are sums of the same products.
AxisAngle turn_between(const Pose& from, const Pose& to) {
  const Mat3 m = to_mat3(to.R) * transpose(to_mat3(from.R));
  const double x = m[0].x, y = m[1].y, z = m[2].z, trace = x + y + z;
  double w;
  Vec3 v;
  const Vec3 odd{m[2].y - m[1].z, m[0].z - m[2].x, m[1].x - m[0].y};
  if (trace >= std::max({x, y, z})) {
    w = 1 + trace, v = odd;
  } else if (x >= y && x >= z) {
    w = odd.x, v = {1 + x - y - z, m[0].y + m[1].x, m[0].z + m[2].x};
  } else if (y >= z) {
    w = odd.y, v = {m[0].y + m[1].x, 1 + y - x - z, m[1].z + m[2].y};
  } else {
    w = odd.z, v = {m[0].z + m[2].x, m[1].z + m[2].y, 1 + z - x - y};
  }
  if (w < 0) w = -w, v = -1.0 * v;
  const double length = norm(v);
  if (!(length > 0)) return {};
  return {(1 / length) * v, 2 * std::atan2(length, w)};
}

/// What is so small beside the rest says nothing: it would only be finer than the exact range allows.
constexpr double kNothing = 0x1p-60;

double without_dust(double value, double of) { return std::abs(value) < kNothing * of ? 0 : value; }

}  // namespace

bool Screw::has_axis(const Pose& from, const Pose& to) { return turn_between(from, to).angle >= 0x1p-10; }

Screw::Screw(const Pose& from, const Pose& to, int turns) : from_(from), to_(to) {
  const auto [axis, least] = turn_between(from, to);
  axis_ = axis, angle_ = least + 2 * std::numbers::pi * turns;
  const Vec3 way = to_vec3(to.t) - turned(angle_) * to_vec3(from.t);
  pitch_ = dot(axis, way);
  shift_ = way - pitch_ * axis;
  const double half = angle_ / 2;
  // sin grows up to a quarter turn; beyond, s(t) may exceed 1.
  if (std::abs(half) > std::numbers::pi / 2) ratio_ = 1.01 / std::abs(std::sin(half));
  const double of_shift = angle_ == 0 ? 1 : half / std::tan(half);
  // Each part is off by less than 10 u of itself.
  const double parts = std::abs(pitch_) + (std::abs(of_shift) + std::abs(half)) * norm(shift_);
  twist_ = {pitch_ * axis + of_shift * shift_ - half * cross(axis, shift_), angle_ * axis, 0x1p-48 * parts};
}

Mat3 Screw::turned(double angle) const {
  const double s = std::sin(angle), h = std::sin(angle / 2), c = 2 * h * h;
  const auto& [x, y, z] = axis_;
  return {Vec3{1 - c * (y * y + z * z), c * x * y - s * z, c * x * z + s * y},
          Vec3{c * x * y + s * z, 1 - c * (x * x + z * z), c * y * z - s * x},
          Vec3{c * x * z - s * y, c * y * z + s * x, 1 - c * (x * x + y * y)}};
}

Pose Screw::at(double time) const {
  if (time <= 0) return from_;
  if (time >= 1) return to_;
  const double angle = time * angle_, half = angle_ / 2, d = (time - 1) * half;
  const double s = angle_ == 0 ? time : std::sin(time * half) / std::sin(half);
  const Mat3 turn = turned(angle);
  const Mat3 R = turn * to_mat3(from_.R);
  const Vec3 carried = turn * to_vec3(from_.t);
  const Vec3 T = time * pitch_ * axis_ + s * (std::cos(d) * shift_ + std::sin(d) * cross(axis_, shift_));
  const double size = sum(abs(to_vec3(from_.t))) + sum(abs(to_vec3(to_.t)));
  Pose pose;
  for (std::size_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) pose.R[3 * i + static_cast<std::size_t>(k)] = without_dust(component(R[i], k), 1);
    pose.t[i] = without_dust(component(carried, static_cast<int>(i)) + component(T, static_cast<int>(i)), size);
  }
  return pose;
}

Twist Screw::twist(double radius) const {
  Twist twist = twist_;
  twist.error += std::abs(angle_) * rounding(radius);
  return twist;
}

// Entries of R are off by 6 u of sin and cos and what multiplies them, and by u |angle|, since t angle is rounded: in
// length at most 11 u and 1.8 u |angle|. Its product with from.R adds 6 u, the product with a vertex and the sums 8 u,
// the turn of from.t 17 u of that; T is off by 12 u and 2 u |angle| of |pitch| + 2 ratio |shift|. In all below
// 64 u (1 + |angle|) of the sum of these lengths; twice that is taken.
double Screw::rounding(double radius) const {
  const double size =
      radius + norm(to_vec3(from_.t)) + norm(to_vec3(to_.t)) + std::abs(pitch_) + 2 * ratio_ * norm(shift_);
  return 0x1p-46 * (1 + std::abs(angle_)) * size;
}

double Screw::deviation(double radius) const {
  const Mat3 turn = turned(angle_), R = turn * to_mat3(from_.R), end = to_mat3(to_.R);
  double off = 0;
  for (std::size_t i = 0; i < 3; ++i) off += dot(R[i] - end[i], R[i] - end[i]);
  const Vec3 missed = (turn * to_vec3(from_.t) + (pitch_ * axis_ + shift_)) - to_vec3(to_.t);
  return rounding(radius) + std::sqrt(off) * radius + norm(missed);
}

}  // namespace impinge::motion
