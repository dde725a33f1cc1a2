// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/point_signs.hpp"

#include <algorithm>

#include "core/number.hpp"
#include "exact/filter.hpp"
#include "exact/segment.hpp"

namespace impinge::solid {
namespace {

using exact::Integer;

/// Differences with a rounded rational are no multiples of 2^-358, so that products may underflow, by less than this.
constexpr double kUnderflow = 0x1p-1000;

int certain_sign(double value, double bound) { return value > bound ? 1 : value < -bound ? -1 : exact::kUnsure; }

}  // namespace

RationalPointSigns::RationalPointSigns(const exact::RationalPoint& p)
    : near_(exact::rounded(p)), off_(0x1p-52 * abs(near_) + Vec3{kUnderflow, kUnderflow, kUnderflow}) {
  denominator_ = lcm(lcm(denominator(p[0]), denominator(p[1])), denominator(p[2]));
  for (std::size_t i = 0; i < 3; ++i) numerators_[i] = numerator(p[i]) * (denominator_ / denominator(p[i]));
}

bool RationalPointSigns::is_double() const {
  for (int axis = 0; axis < 3; ++axis) {
    const double x = component(near_, axis);
    if (!difference(x, axis, x != 0 ? std::min(0, lowest_bit(x)) : 0).is_zero()) return false;
  }
  return true;
}

Integer RationalPointSigns::difference(double from, int axis, int unit) const {
  return (numerators_[static_cast<std::size_t>(axis)] << -unit) - exact::integer(from, unit) * denominator_;
}

int RationalPointSigns::sign_of_difference(double x, int axis) const {
  const double rounded = x - component(near_, axis);  // the sign is right, and the relative error 2^-53
  const int sign = certain_sign(rounded, 2 * component(off_, axis));
  return sign != exact::kUnsure ? sign : -difference(x, axis, x != 0 ? std::min(0, lowest_bit(x)) : 0).sign();
}

int RationalPointSigns::turn(const exact::Projection& projection, const Vec3& u, const Vec3& v) const {
  const double pa = component(near_, projection.u), pb = component(near_, projection.v);
  const double ua = component(u, projection.u), ub = component(u, projection.v);
  const double va = component(v, projection.u), vb = component(v, projection.v);
  const double left = (ua - pa) * (vb - pb), right = (ub - pb) * (va - pa);
  const double moved =
      component(off_, projection.u) * std::abs(ub - vb) + component(off_, projection.v) * std::abs(ua - va);
  const double bound = exact::kOrient2dBound * (std::abs(left) + std::abs(right)) + 2 * moved + kUnderflow;
  const int sign = certain_sign(left - right, bound);
  if (sign != exact::kUnsure) return sign;
  const int unit = exact::lowest_bit_of(std::array{u, v}, 0);
  return Integer(difference(ua, projection.u, unit) * difference(vb, projection.v, unit) -
                 difference(ub, projection.v, unit) * difference(va, projection.u, unit))
      .sign();
}

int RationalPointSigns::side(const Triangle& t) const {
  const exact::FilteredNormal filtered(t[1] - t[0], t[2] - t[0]);
  const Vec3 w = near_ - t[0];
  const double permanent = dot(abs(w), filtered.magnitude), moved = dot(off_, filtered.magnitude);
  const int sign = certain_sign(dot(w, filtered.normal), exact::kOrient3dBound * permanent + 2 * moved + kUnderflow);
  if (sign != exact::kUnsure) return sign;
  const int unit = exact::lowest_bit_of(t, 0);
  std::array<Integer, 3> p, q;
  for (int i = 0; i < 3; ++i) {
    const Integer origin = exact::integer(component(t[0], i), unit);
    p[i] = exact::integer(component(t[1], i), unit) - origin;
    q[i] = exact::integer(component(t[2], i), unit) - origin;
  }
  Integer determinant;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    determinant += difference(component(t[0], i), i, unit) * (p[j] * q[k] - p[k] * q[j]);
  }
  return determinant.sign();
}

template <class PointSigns>
bool lies_on(const PointSigns& point, const Triangle& t) {
  for (int axis = 0; axis < 3; ++axis) {
    int below = 0, above = 0;
    for (const Vec3& v : t) {
      const int sign = point.sign_of_difference(component(v, axis), axis);
      below += int{sign <= 0}, above += int{sign >= 0};
    }
    if (below == 0 || above == 0) return false;
  }
  const int proper = exact::find_projection(t[0], t[1], t[2]);
  if (proper < 0) {  // a point in the box of a segment is on it if and only if it is on its line
    const Segment segment = exact::extremes(t);
    for (const exact::Projection& projection : exact::kProjections)
      if (point.turn(projection, segment[0], segment[1]) != 0) return false;
    return true;
  }
  if (point.side(t) != 0) return false;
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int turn = point.turn(exact::kProjections[static_cast<std::size_t>(proper)], t[i], t[(i + 1) % 3]);
    left += int{turn > 0}, right += int{turn < 0};
  }
  return left == 0 || right == 0;
}

template bool lies_on(const DoublePoint&, const Triangle&);
template bool lies_on(const RationalPointSigns&, const Triangle&);

}  // namespace impinge::solid
