// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

#include "core/vec3.hpp"

/// Rational numbers: for the few constructions (points, not signs) that must be exact.
namespace impinge::exact {

using Rational = boost::multiprecision::cpp_rational;
using RationalPoint = std::array<Rational, 3>;

inline RationalPoint rational(const Vec3& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }

/// Within 2^-52 of x, relatively, or 2^-1074 where that is more.
inline double rounded(const Rational& x) {
  using boost::multiprecision::cpp_int;
  if (x.is_zero()) return 0;
  const cpp_int numerator = abs(boost::multiprecision::numerator(x)),
                denominator = boost::multiprecision::denominator(x);
  const int shift = 63 + static_cast<int>(msb(denominator)) - static_cast<int>(msb(numerator));
  // Above 2^62 and below 2^64, so that what is cut off is below 2^-62 of it.
  const cpp_int quotient =
      shift >= 0 ? cpp_int((numerator << shift) / denominator) : cpp_int(numerator / (denominator << -shift));
  const double magnitude = std::ldexp(static_cast<double>(static_cast<std::uint64_t>(quotient)), -shift);
  return x.sign() < 0 ? -magnitude : magnitude;
}
inline Vec3 rounded(const RationalPoint& p) { return {rounded(p[0]), rounded(p[1]), rounded(p[2])}; }

}  // namespace impinge::exact
