// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hierarchy/frame.hpp"

namespace impinge::hierarchy {

/// A leaf's box is {x : |x| <= half}: its origin is the box's centre. After the header come nine rows of `stride`
/// floats, the x of the triangles' first vertices, their y, their z, the x of the second vertices and so on, and a row
/// of `stride` mesh triangle ids. `stride` is a multiple of 16, the most lanes that a reader takes at once, so that
/// rows are aligned to 64 bytes and nobody reads beyond the leaf. Beyond `count` the coordinates are kNoTriangle.
struct alignas(64) WideLeaf {
  /// Far outside of anything that may be tested, and finite.
  static constexpr float kNoTriangle = 1e30f;

  Frame frame;
  float half[3];
  float error;  ///< the stored coordinates are within this of the exact ones, each
  /// |F⁻¹x - Fᵀx| of a stored point x is at most this, for F is orthonormal only to rounding.
  float inverse_error;
  std::uint32_t count, stride;

  [[nodiscard]] const float* row(int i) const {
    return reinterpret_cast<const float*>(this + 1) + std::size_t{stride} * static_cast<unsigned>(i);
  }
  [[nodiscard]] const std::uint32_t* ids() const { return reinterpret_cast<const std::uint32_t*>(row(9)); }
};

/// Two leaves whose boxes may overlap.
struct WideLeafPair {
  const WideLeaf* a;
  const WideLeaf* b;
};

}  // namespace impinge::hierarchy
