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
  /// The edges on which it lies exactly, or-ed: 1 << i for a's edge from its corner i to the next, 8 << i for b's. None
  /// of a triangle without area.
  std::uint8_t edges;
};

/// What two triangles share: nothing, a point, a segment, or (only if they are coplanar) a convex polygon, whose
/// corners are in order along its border. Which corners there are and how they follow each other is exact.
struct SharedPart {
  std::array<Corner, 6> corners;
  std::uint8_t size = 0;
};

/// Degenerate triangles are the segment or point that they are.
SharedPart shared_part(const Triangle& a, const Triangle& b);

/// A corner that both have and that is certainly all that they share: what `shared_part` would find, in a small part of
/// the time. Nothing where floating point is not certain.
std::optional<Corner> common_vertex(const Triangle& a, const Triangle& b);

}  // namespace impinge::clash
