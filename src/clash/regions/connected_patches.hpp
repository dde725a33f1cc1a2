// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.hpp"

namespace impinge::clash {

/// A piece of what a triangle shares with the triangles of another body: a segment or a point.
struct Mark {
  Vec3 from, to;
  std::uint32_t contact;
  bool on_border;  ///< an end of it lies on an edge of the triangle
};

/// What is seen from a patch: marks that hang together without reaching the triangle's border. Between `from` and
/// `to` there is no other mark.
struct Sight {
  Vec3 from, to;
  std::uint32_t patch;  ///< a contact of it
  std::uint32_t seen;   ///< a contact; kBorder and more: the triangle's edge of that number

  static constexpr std::uint32_t kBorder = 0xfffffffd;
};

/// One look from each patch, so that by all of them together whatever borders one and the same cell of the triangle
/// hangs together: each patch looks from its outermost point along one axis, and so sees something that reaches
/// farther, or the border. Up to rounding.
std::vector<Sight> sights(const Triangle& triangle, std::span<const Mark> marks);

}  // namespace impinge::clash
