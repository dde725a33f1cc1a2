// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/integers.hpp"

#include <bit>

namespace impinge::exact {
namespace {

/// Brings the largest number to between 2^59 and 2^60; 0 outside the exact domain.
double scale_of(double largest) {
  constexpr std::uint64_t kBias = 1023;
  const std::uint64_t exponent = largest == 0 ? kBias : std::bit_cast<std::uint64_t>(largest) >> 52;
  if (exponent < kBias - 358 || exponent > kBias + 300) return 0;
  return std::bit_cast<double>((2 * kBias + 59 - exponent) << 52);
}

}  // namespace

bool to_integers(std::span<const Vec3> points, IntVec* integers) {
  Vec3 largest{0, 0, 0};
  for (const Vec3& p : points) largest = max(largest, abs(p));
  const Vec3 scale{scale_of(largest.x), scale_of(largest.y), scale_of(largest.z)};
  if (scale.x == 0 || scale.y == 0 || scale.z == 0) return false;
  bool whole = true;
  const auto to_integer = [&](double x) {
    const auto integer = static_cast<std::int64_t>(x);
    whole &= static_cast<double>(integer) == x;
    return integer;
  };
  for (const Vec3& p : points)
    *integers++ = {to_integer(scale.x * p.x), to_integer(scale.y * p.y), to_integer(scale.z * p.z)};
  return whole;
}

}  // namespace impinge::exact
