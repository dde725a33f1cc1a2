// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "clash/local_frame.hpp"
#include "clash/near_cells.hpp"

namespace impinge::clash {

/// The direction that tells the sides of a surface at a point of one of its triangles: what has its nearest point there
/// is in front of the triangle if it lies along it. Within a face that is its normal; on an edge the sum of both
/// faces', and in a vertex that of all, by their angles (Baerentzen and Aanaes, Signed distance computation using the
/// angle weighted pseudonormal, 2005), all turned as the triangle is. Not of unit length.
///
/// Nothing where the surface ends or branches, where it is folded up flat or a normal is not known well enough, and in
/// vertices of very many triangles.
struct Foot {
  std::uint32_t triangle;
  Vec3 point;   ///< of the triangle, in local coordinates
  double near;  ///< no farther than that from an edge or a vertex it is taken to be on it
};
std::optional<Vec3> pseudo_normal(const LinkedPart& part, const LocalFrame& frame, const Foot& foot);

}  // namespace impinge::clash
