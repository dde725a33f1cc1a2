// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/vec3.hpp"

namespace impinge::clash {

/// A corner of what two triangles share, rounded once.
struct Corner {
  Vec3 point;
  /// The edges on which it lies exactly, or-ed: 1 << i for a's edge from its corner i to the next, 8 << i for b's.
  /// Edges of a degenerate triangle are left out.
  std::uint8_t edges;
};

/// What two triangles share: nothing, a point, a segment, or (only if they are coplanar) a convex polygon, whose
/// corners are in order along its border. Which corners there are and how they follow each other is exact.
struct SharedPart {
  std::array<Corner, 6> corners;
  std::uint8_t size = 0;
};

/// A degenerate triangle counts as the segment or point that it is.
SharedPart shared_part(const Triangle& a, const Triangle& b);

/// A common corner that is certainly all that the triangles share: the result of `shared_part` in a small part of the
/// time. Nothing where floating point is not certain.
std::optional<Corner> common_vertex(const Triangle& a, const Triangle& b);

}  // namespace impinge::clash
