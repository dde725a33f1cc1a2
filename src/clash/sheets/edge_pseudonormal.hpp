// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "clash/cells_within.hpp"
#include "clash/sheets/sheet_ends.hpp"
#include "core/local_frame.hpp"

namespace impinge::clash {

/// A triangle of a part, with its local coordinates.
struct PartTriangle {
  const solid::Part& part;
  const SheetEnds& ends;
  const LocalFrame& frame;
  std::uint32_t id;
  Triangle local;
};

/// Whether the surface is bent by more than an angle of 2^-6 at one of the triangle's edges.
bool is_bent_around(const PartTriangle& triangle);

/// On which side of the surface, oriented as the triangle, a point is whose nearest point on the triangle and its
/// neighbour is on their common edge, farther than `beyond`: the side of the edge pseudonormal, the sum of the two
/// normals (Baerentzen and Aanaes, Signed distance computation using the angle weighted pseudonormal, 2005).
///
/// Returns 0 for all other points, and where the surface ends or branches, is folded flat, or a normal is not known
/// well enough. Corners return 0 too: two triangles that meet only at a vertex have no common line to take sides of.
std::uint8_t edge_pseudonormal_side(const PartTriangle& triangle, const Vec3& point, double beyond);

}  // namespace impinge::clash
