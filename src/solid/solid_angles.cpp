// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/solid_angles.hpp"

#include <cmath>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solid/solid_angles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace impinge::solid::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, EightTriangles::kCount>;
using V = hn::Vec<D>;

struct Vector {
  V x, y, z;
};

// Products are rounded before they are added, so that the sums are the same on every machine.
HWY_INLINE V dot(const Vector& p, const Vector& q) {
  return hn::Add(hn::Add(hn::Mul(p.x, q.x), hn::Mul(p.y, q.y)), hn::Mul(p.z, q.z));
}
HWY_INLINE Vector cross(const Vector& p, const Vector& q) {
  return {hn::Sub(hn::Mul(p.y, q.z), hn::Mul(p.z, q.y)), hn::Sub(hn::Mul(p.z, q.x), hn::Mul(p.x, q.z)),
          hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x))};
}
HWY_INLINE V length(const Vector& p) { return hn::Sqrt(dot(p, p)); }

/// Multiplies the numbers (x, y) by those of the triangles.
void multiply_by(const EightTriangles& triangles, const Vec3& from, double* xs, double* ys, double* rounds) {
  const D d;
  const V origin[3] = {hn::Set(d, from.x), hn::Set(d, from.y), hn::Set(d, from.z)};
  for (std::size_t i = 0; i < EightTriangles::kCount; i += hn::Lanes(d)) {
    const auto to_corner = [&](std::size_t corner) HWY_ATTR {
      const auto& [x, y, z] = triangles.corners[corner];
      return Vector{hn::Sub(hn::Load(d, x.data() + i), origin[0]), hn::Sub(hn::Load(d, y.data() + i), origin[1]),
                    hn::Sub(hn::Load(d, z.data() + i), origin[2])};
    };
    const Vector a = to_corner(0), b = to_corner(1), c = to_corner(2);
    const V la = length(a), lb = length(b), lc = length(c);
    const V x = hn::Add(hn::Add(hn::Mul(hn::Mul(la, lb), lc), hn::Mul(dot(a, b), lc)),
                        hn::Add(hn::Mul(dot(b, c), la), hn::Mul(dot(c, a), lb)));
    const V y = dot(a, cross(b, c));

    const V old_x = hn::Load(d, xs + i), old_y = hn::Load(d, ys + i), zero = hn::Zero(d), one = hn::Set(d, 1);
    const V new_x = hn::Sub(hn::Mul(old_x, x), hn::Mul(old_y, y)),
            new_y = hn::Add(hn::Mul(old_x, y), hn::Mul(old_y, x));
    const auto is_old_negative = hn::Lt(old_y, zero), is_negative = hn::Lt(y, zero),
               is_new_negative = hn::Lt(new_y, zero);
    const auto is_more = hn::AndNot(hn::Or(is_old_negative, is_negative), is_new_negative);
    const auto is_less = hn::AndNot(is_new_negative, hn::And(is_old_negative, is_negative));
    const V more = hn::IfThenElseZero(is_more, one), less = hn::IfThenElseZero(is_less, one);
    hn::Store(hn::Add(hn::Load(d, rounds + i), hn::Sub(more, less)), d, rounds + i);
    // 0 where the point is on an edge
    const V size = hn::Add(hn::Abs(new_x), hn::Abs(new_y));
    const auto turns = hn::Gt(size, zero);
    hn::Store(hn::IfThenElse(turns, hn::Div(new_x, size), old_x), d, xs + i);
    hn::Store(hn::IfThenElse(turns, hn::Div(new_y, size), old_y), d, ys + i);
  }
}

}  // namespace impinge::solid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::solid {
HWY_EXPORT(multiply_by);

void SolidAngles::add(const EightTriangles& triangles, const Vec3& from) {
  HWY_DYNAMIC_DISPATCH(multiply_by)(triangles, from, x_.data(), y_.data(), rounds_.data());
}

double SolidAngles::sum() const {
  double halves = 0;
  for (std::size_t i = 0; i < EightTriangles::kCount; ++i)
    halves += 2 * std::numbers::pi * rounds_[i] + std::atan2(y_[i], x_[i]);
  return 2 * halves;
}

}  // namespace impinge::solid
#endif  // HWY_ONCE
