// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/vec3.hpp"

namespace impinge::hierarchy {

/// Axes for soup triangles: x = scale F (s - center), row i of F being axis i.
struct SoupFrame {
  float center[4];   ///< the fourth is 0
  float axes[3][4];  ///< axes[l][i] is component l of axis i; the fourth lane is 0
  float scale;       ///< a power of two, so that products of two x are in range

  /// Makes the centre what it is once base + center has been rounded to double: far from the origin, not the same.
  /// Returns the sum.
  Vec3 settle(const Vec3& base) {
    const Vec3 origin = base + Vec3{center[0], center[1], center[2]};
    const Vec3 settled = origin - base;
    center[0] = static_cast<float>(settled.x), center[1] = static_cast<float>(settled.y);
    center[2] = static_cast<float>(settled.z);
    return origin;
  }

  /// A power of two, 1 over `reach` or up to twice that. Coordinates are at most 1, so x is at most 2^51, which leaves
  /// sums of squares in range.
  static float scale_for(float reach) {
    constexpr std::uint32_t kOne = 127, kMost = kOne + 50;  // as exponents
    const std::uint32_t exponent = std::bit_cast<std::uint32_t>(reach) >> 23;
    return std::bit_cast<float>(std::clamp(2 * kOne - exponent, kOne, kMost) << 23);
  }
};

}  // namespace impinge::hierarchy
