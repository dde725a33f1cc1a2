// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/number.hpp"
#include "core/vec3.hpp"

/// Rational numbers: for the few constructions (points, not signs) that must be exact.
namespace impinge::exact {

using Rational = boost::multiprecision::cpp_rational;
using RationalPoint = std::array<Rational, 3>;
using Integer = boost::multiprecision::cpp_int;

/// x / 2^unit, of which x is a multiple.
inline Integer integer(double x, int unit) {
  if (x == 0) return 0;
  const int lowest = lowest_bit(x);
  return Integer(static_cast<std::int64_t>(std::ldexp(x, -lowest))) << (lowest - unit);
}

/// The exponent of the lowest bit set in any coordinate of any point, or `lowest` if that is less.
inline int lowest_bit_of(std::span<const Vec3> points, int lowest) {
  for (const Vec3& p : points)
    for (const double x : {p.x, p.y, p.z})
      if (x != 0) lowest = std::min(lowest, lowest_bit(x));
  return lowest;
}

inline RationalPoint rational(const Vec3& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }

/// Within 2^-52 of x, relatively, or 2^-1074 where that is more.
inline double rounded(const Rational& x) {
  if (x.is_zero()) return 0;
  const Integer numerator = abs(boost::multiprecision::numerator(x)),
                denominator = boost::multiprecision::denominator(x);
  const int shift = 63 + static_cast<int>(msb(denominator)) - static_cast<int>(msb(numerator));
  // Above 2^62 and below 2^64, so that what is cut off is below 2^-62 of it.
  const Integer quotient =
      shift >= 0 ? Integer((numerator << shift) / denominator) : Integer(numerator / (denominator << -shift));
  const double magnitude = std::ldexp(static_cast<double>(static_cast<std::uint64_t>(quotient)), -shift);
  return x.sign() < 0 ? -magnitude : magnitude;
}
inline Vec3 rounded(const RationalPoint& p) { return {rounded(p[0]), rounded(p[1]), rounded(p[2])}; }

}  // namespace impinge::exact
