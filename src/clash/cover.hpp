// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "clash/polygon.hpp"
#include "solid/body.hpp"

namespace impinge::clash {

/// A piece of a triangle, and what it may lie flat on.
struct CoverSearch {
  const Triangle& whole;                ///< that the piece is of
  const Polygon& piece;                 ///< its points are off by `w` at most
  const solid::Body& other;             ///< what the piece is held against
  std::span<const std::uint32_t> near;  ///< its triangles, all that are within 3.5 w of the piece among them
  double w;                             ///< 2^-45 of the largest coordinate of all of them, or more
};

/// Whether each point of the piece is within 2.5 w of the other's triangles, because the piece lies flat on some that
/// cover it together. False where it is not certain.
bool is_covered(const CoverSearch& search);

}  // namespace impinge::clash
