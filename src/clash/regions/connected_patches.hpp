// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.hpp"

namespace impinge::clash {

/// A segment or point that a triangle shares with a triangle of another body.
struct Mark {
  Vec3 from, to;
  std::uint32_t contact;
  bool on_border;  ///< whether an end of it lies on an edge of the triangle
};

/// A line of sight from a connected patch of marks, none of which reaches the triangle's border, to the next mark or to
/// the border. Between `from` and `to` there is no other mark.
struct Sight {
  Vec3 from, to;
  std::uint32_t patch;  ///< a contact of the patch
  std::uint32_t seen;   ///< a contact, or kBorder plus the number of the triangle's edge

  static constexpr std::uint32_t kBorder = 0xfffffffd;
};

/// One line of sight from each connected patch. Together they connect all marks that border the same cell of the
/// triangle: each starts at the patch's outermost point along one axis, and so ends on a mark that reaches farther, or
/// on the border. Up to rounding.
std::vector<Sight> sights(const Triangle& triangle, std::span<const Mark> marks);

}  // namespace impinge::clash
