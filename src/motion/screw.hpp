// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/twist.hpp"

namespace impinge::motion {

/// The screw motion from one pose to another: at time t the point x of the world at time 0 is at
///     R(t angle) x + T(t),  T(t) = t pitch axis + s(t) (cos(d) shift + sin(d) axis × shift),
/// R turning about the direction `axis`, d = (t - 1) angle / 2 and s(t) = sin(t angle / 2) / sin(angle / 2), or t where
/// the angle is 0. This is the turn about the axis through c = (shift + cot(angle / 2) axis × shift) / 2 and the way
/// along it, without c, which is far away where the angle is small. `axis`, `angle`, `pitch` and `shift` are taken as
/// the doubles that they are; that the motion then ends a little beside `to` is in `deviation`.
class Screw {
 public:
  /// Both poses are valid; `turns` is 0 where the matrices are equal.
  Screw(const Pose& from, const Pose& to, int turns);

  /// Rounded; `from` at 0, `to` at 1.
  [[nodiscard]] Pose at(double time) const;
  /// Of a body within `radius` of its own origin, at any time.
  [[nodiscard]] Twist twist(double radius) const;
  /// How far world vertices at a pose of `at` may be from where the motion has them: by rounding, and at the end by
  /// what `to` is beside it.
  [[nodiscard]] double deviation(double radius) const;
  /// Whether the least angle is large enough to tell an axis about which to make whole turns.
  [[nodiscard]] static bool has_axis(const Pose& from, const Pose& to);

 private:
  [[nodiscard]] Mat3 turned(double angle) const;
  [[nodiscard]] double rounding(double radius) const;

  Pose from_, to_;
  Vec3 axis_{0, 0, 0}, shift_{0, 0, 0};
  double angle_ = 0, pitch_ = 0;
  double ratio_ = 1;  ///< at least |s(t)|
  Twist twist_;
};

}  // namespace impinge::motion
