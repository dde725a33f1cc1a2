// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/vec3.hpp"
#include "exact/orientation.hpp"
#include "exact/rational.hpp"

/// Exact predicates of a point with vertices, edges and planes: one interface for points in double and in rational
/// numbers.
namespace impinge::solid {

class DoublePoint {
 public:
  explicit DoublePoint(const Vec3& p) : p_(p) {}
  /// The sign of x - p along an axis.
  [[nodiscard]] int sign_of_difference(double x, int axis) const {
    const double p = component(p_, axis);
    return x < p ? -1 : int{x > p};
  }
  /// The sign of orient2d(u, v, p).
  [[nodiscard]] int turn(const exact::Projection& projection, const Vec3& u, const Vec3& v) const {
    return exact::orient2d(projection, u, v, p_);
  }
  /// The sign of orient3d(a, b, c, p).
  [[nodiscard]] int side(const Triangle& t) const { return exact::orient3d(t[0], t[1], t[2], p_); }
  /// The point rounded: relatively within 2^-52 of it, per coordinate.
  [[nodiscard]] const Vec3& near() const { return p_; }

 private:
  Vec3 p_;
};

/// Computes in floating point first, with the rounded point: each predicate is linear in the point, so that rounding
/// changes it by at most the rounding error times the coefficients.
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
  /// The difference of p and a coordinate, a multiple of 2^unit, times the denominator and 2^-unit.
  [[nodiscard]] exact::Integer difference(double from, int axis, int unit) const;

  std::array<exact::Integer, 3> numerators_;
  exact::Integer denominator_;  ///< common to all three
  Vec3 near_, off_;             ///< the point is within `off_` of `near_`, per coordinate
};

/// Whether a point lies on a closed triangle, degenerate ones included.
template <class PointSigns>
bool lies_on(const PointSigns& point, const Triangle& t);

extern template bool lies_on(const DoublePoint&, const Triangle&);
extern template bool lies_on(const RationalPointSigns&, const Triangle&);

}  // namespace impinge::solid
