// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "clash/polygon.hpp"
#include "solid/body.hpp"

namespace impinge::clash {

/// A piece of a triangle, and the triangles of the other body on which it may lie flat.
struct CoverSearch {
  const Triangle& whole;                ///< the triangle from which the piece was cut
  const Polygon& piece;                 ///< each of its points is off by `w` at most
  const solid::Body& other;             ///< the body on which the piece may lie
  std::span<const std::uint32_t> near;  ///< triangles of `other`: at least all within 3.5 w of the piece
  double w;                             ///< at least 2^-45 of the largest coordinate of both bodies
};

/// Whether each point of the piece is within 2.5 w of the other body's triangles, because the piece lies flat on
/// several that together cover it. False where that is not certain.
bool is_covered(const CoverSearch& search);

}  // namespace impinge::clash
