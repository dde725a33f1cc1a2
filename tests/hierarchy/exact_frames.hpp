// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmpxx.h>

#include <array>
#include <cmath>

#include "hierarchy/frame.hpp"
#include "impinge/mesh.hpp"

/// Where points lie, in rational numbers.
namespace impinge::test {

using Rational3 = std::array<mpq_class, 3>;

inline Rational3 rational(const Point& p) { return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)}; }

inline Rational3 difference(const Rational3& a, const Rational3& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
inline mpq_class square(const Rational3& a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }

/// The same point in units of 2^unit_exponent.
inline Rational3 in_unit(Rational3 p, int unit_exponent) {
  const auto shift = static_cast<mp_bitcnt_t>(std::abs(unit_exponent));
  for (mpq_class& x : p) {
    if (unit_exponent > 0) mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), shift);
    if (unit_exponent < 0) mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), shift);
  }
  return p;
}

/// x in `frame`, of a point in the tree's unit.
inline Rational3 in_frame(const hierarchy::Frame& frame, const Rational3& point) {
  Rational3 x;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t l = 0; l < 3; ++l) x[i] += mpq_class(frame.axes[l][i]) * (point[l] - mpq_class(frame.origin[l]));
  return x;
}

/// Takes the world to a mesh, in units of 2^unit_exponent: R⁻¹ (X - t).
class Unposed {
 public:
  Unposed(const Pose& pose, int unit_exponent)
      : t_{mpq_class(pose.t[0]), mpq_class(pose.t[1]), mpq_class(pose.t[2])}, unit_exponent_(unit_exponent) {
    const auto R = [&](std::size_t i, std::size_t k) { return mpq_class(pose.R[3 * i + k]); };
    const auto cofactor = [&](std::size_t i, std::size_t k) -> mpq_class {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      return R(i1, k1) * R(i2, k2) - R(i1, k2) * R(i2, k1);
    };
    const mpq_class determinant = R(0, 0) * cofactor(0, 0) + R(0, 1) * cofactor(0, 1) + R(0, 2) * cofactor(0, 2);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) inverse_[k][i] = cofactor(i, k) / determinant;
  }

  [[nodiscard]] Rational3 direction(const Rational3& d) const {
    Rational3 result;
    for (std::size_t i = 0; i < 3; ++i)
      result[i] = inverse_[i][0] * d[0] + inverse_[i][1] * d[1] + inverse_[i][2] * d[2];
    return in_unit(std::move(result), unit_exponent_);
  }
  [[nodiscard]] Rational3 operator()(const Point& world) const { return direction(difference(rational(world), t_)); }

 private:
  Rational3 t_;
  std::array<Rational3, 3> inverse_;
  int unit_exponent_;
};

}  // namespace impinge::test
