// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace impinge {

/// floor(log2|x|) of a finite non-zero x.
inline int exponent(double x) { return std::ilogb(x); }

/// The exponent of the lowest bit set in a finite non-zero x: x is an odd multiple of two to this power.
inline int lowest_bit(double x) {
  constexpr std::uint64_t kFraction = (std::uint64_t{1} << 52) - 1;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int biased = static_cast<int>(bits >> 52 & 0x7FF);
  const std::uint64_t significand = (bits & kFraction) | (biased == 0 ? 0 : kFraction + 1);
  return (biased == 0 ? 1 : biased) - 1075 + std::countr_zero(significand);
}

}  // namespace impinge
