// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/vec3.hpp"
#include "exact/orientation.hpp"
#include "exact/rational.hpp"

/// How a point lies to vertices, edges and planes, exactly: one interface for points in double and in rational numbers.
namespace impinge::solid {

class DoublePoint {
 public:
  explicit DoublePoint(const Vec3& p) : p_(p) {}
  /// Of x - p along an axis.
  [[nodiscard]] int sign_of_difference(double x, int axis) const {
    const double p = component(p_, axis);
    return x < p ? -1 : int{x > p};
  }
  /// orient2d(u, v, p).
  [[nodiscard]] int turn(const exact::Projection& projection, const Vec3& u, const Vec3& v) const {
    return exact::orient2d(projection, u, v, p_);
  }
  /// orient3d(a, b, c, p).
  [[nodiscard]] int side(const Triangle& t) const { return exact::orient3d(t[0], t[1], t[2], p_); }
  /// Relatively within 2^-52 of the point, per coordinate.
  [[nodiscard]] const Vec3& near() const { return p_; }

 private:
  Vec3 p_;
};

/// Floating point first, about the rounded point: all of these are linear in the point, so that what the rounding
/// changes is at most its size times the coefficients.
class RationalPointSigns {
 public:
  explicit RationalPointSigns(const exact::RationalPoint& p);
  [[nodiscard]] int sign_of_difference(double x, int axis) const;
  [[nodiscard]] int turn(const exact::Projection& projection, const Vec3& u, const Vec3& v) const;
  [[nodiscard]] int side(const Triangle& t) const;
  [[nodiscard]] const Vec3& near() const { return near_; }
  /// Whether the point is `near()`.
  [[nodiscard]] bool is_double() const;

 private:
  /// How far p is from a coordinate, times the denominator and 2^-unit, of which the coordinate is a multiple.
  [[nodiscard]] exact::Integer difference(double from, int axis, int unit) const;

  std::array<exact::Integer, 3> numerators_;
  exact::Integer denominator_;  ///< of all three
  Vec3 near_, off_;             ///< the point is within `off_` of `near_`, per coordinate
};

/// Whether a point lies on a closed triangle, degenerate ones included.
template <class PointSigns>
bool lies_on(const PointSigns& point, const Triangle& t);

extern template bool lies_on(const DoublePoint&, const Triangle&);
extern template bool lies_on(const RationalPointSigns&, const Triangle&);

}  // namespace impinge::solid
