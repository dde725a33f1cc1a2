// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/rounded_point.hpp"

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <limits>
#include <span>

namespace impinge::clash {
namespace {

namespace mp = boost::multiprecision;

/// Integers of 256 bits, on the stack, unchecked: with coordinates below 2^60, differences are below 2^61, determinants
/// of three of them below 2^187, and the sum in a coordinate's numerator below 2^249.
using Fixed = mp::number<mp::cpp_int_backend<256, 256, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;
/// Integers of any length: 660 bits hold a coordinate of the exact domain.
using Any = mp::number<mp::cpp_int_backend<>, mp::et_off>;
constexpr int kFixedBits = 60;

/// mantissa * 2^exponent; the mantissa is odd or 0.
struct Binary {
  std::int64_t mantissa;
  int exponent;
};

Binary binary(double x) {
  if (x == 0) return {0, std::numeric_limits<int>::max()};
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  return {mantissa >> zeros, exponent - 53 + zeros};
}

/// Up to five points as integers times a power of two for each axis. That is an affine map, so it keeps points of
/// intersection and ratios along a line.
struct Scaled {
  static constexpr std::size_t kMost = 5;
  std::array<std::array<Binary, 3>, kMost> points;
  std::array<int, 3> exponent;  ///< of the lowest bit, per axis
  int bits = 0;                 ///< the length of the largest integer

  explicit Scaled(std::span<const Vec3> from) {
    exponent.fill(std::numeric_limits<int>::max());
    for (std::size_t i = 0; i < from.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        points[i][k] = binary(component(from[i], k));
        exponent[k] = std::min(exponent[k], points[i][k].exponent);
      }
    for (std::size_t i = 0; i < from.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (const auto& [mantissa, e] = points[i][k]; mantissa != 0)
          bits = std::max(
              bits, e - exponent[k] + static_cast<int>(std::bit_width(static_cast<std::uint64_t>(std::abs(mantissa)))));
  }
  template <class Int>
  [[nodiscard]] std::array<Int, 3> integers(std::size_t point) const {
    std::array<Int, 3> result;
    for (int k = 0; k < 3; ++k) {
      result[k] = points[point][k].mantissa;
      if (points[point][k].mantissa != 0) result[k] <<= points[point][k].exponent - exponent[k];
    }
    return result;
  }
};

/// The double nearest to n / d * 2^exponent; d is not 0.
template <class Int>
double rounded(Int n, Int d, int exponent) {
  if (n == 0) return 0;
  const bool negative = (n < 0) != (d < 0);
  n = abs(n), d = abs(d);
  // The quotient has 55 or 56 bits, the last of which also stands for all bits that follow: converting it rounds once.
  const int shift = 55 + static_cast<int>(msb(d)) - static_cast<int>(msb(n));
  if (shift > 0) n <<= shift;
  if (shift < 0) d <<= -shift;
  Int quotient, remainder;
  divide_qr(n, d, quotient, remainder);
  const std::uint64_t digits = static_cast<std::uint64_t>(quotient) | std::uint64_t{remainder != 0};
  const double magnitude = std::ldexp(static_cast<double>(digits), exponent - shift);
  return negative ? -magnitude : magnitude;
}

/// The point that divides p q as s : -t, s and t being of opposite signs: (s q - t p) / (s - t).
template <class Int>
Vec3 divided(const std::array<Int, 3>& p, const std::array<Int, 3>& q, const Int& s, const Int& t,
             const Scaled& scaled) {
  const auto coordinate = [&](int k) { return rounded<Int>(s * q[k] - t * p[k], s - t, scaled.exponent[k]); };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

template <class Int>
std::array<Int, 3> difference(const std::array<Int, 3>& from, const std::array<Int, 3>& to) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

template <class Int>
Vec3 through(const Scaled& scaled) {
  const auto p = scaled.integers<Int>(0), q = scaled.integers<Int>(1), o = scaled.integers<Int>(2);
  const auto u = difference(o, scaled.integers<Int>(3)), v = difference(o, scaled.integers<Int>(4));
  const std::array<Int, 3> normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const auto height = [&](const std::array<Int, 3>& x) {
    const auto w = difference(o, x);
    return Int{w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]};
  };
  return divided<Int>(p, q, height(p), height(q), scaled);
}

template <class Int>
Vec3 across(const Scaled& scaled, const exact::Projection& plane) {
  const auto p = scaled.integers<Int>(0), q = scaled.integers<Int>(1), o = scaled.integers<Int>(2);
  const auto along = difference(o, scaled.integers<Int>(3));
  const auto height = [&](const std::array<Int, 3>& x) {
    const auto w = difference(o, x);
    return Int{along[plane.u] * w[plane.v] - along[plane.v] * w[plane.u]};
  };
  return divided<Int>(p, q, height(p), height(q), scaled);
}

}  // namespace

Vec3 where_through(const Segment& edge, const Triangle& plane) {
  const Scaled scaled(std::array{edge[0], edge[1], plane[0], plane[1], plane[2]});
  return scaled.bits <= kFixedBits ? through<Fixed>(scaled) : through<Any>(scaled);
}

Vec3 where_across(const Segment& edge, const Segment& other, const exact::Projection& p) {
  const Scaled scaled(std::array{edge[0], edge[1], other[0], other[1]});
  return scaled.bits <= kFixedBits ? across<Fixed>(scaled, p) : across<Any>(scaled, p);
}

}  // namespace impinge::clash
