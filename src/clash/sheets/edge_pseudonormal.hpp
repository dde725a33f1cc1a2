// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "clash/cells_within.hpp"
#include "clash/local_frame.hpp"
#include "clash/sheets/sheet_ends.hpp"

namespace impinge::clash {

/// A triangle of a part, in local coordinates too.
struct PartTriangle {
  const solid::Part& part;
  const SheetEnds& ends;
  const LocalFrame& frame;
  std::uint32_t id;
  Triangle local;
};

/// Whether the surface is bent by more than an angle of 2^-6 at one of the triangle's edges.
bool is_bent_around(const PartTriangle& triangle);

/// On which side of the surface, as the triangle looks, a point is that is farther than `beyond` from one of the
/// triangle's edges and, of both triangles there, has its nearest point on that edge: the side of the sum of their
/// normals (Baerentzen and Aanaes, Signed distance computation using the angle weighted pseudonormal, 2005).
///
/// 0 for all other points; also where the surface ends or branches, is folded up flat, or a normal is not known well
/// enough. So it is at corners: what is near in a corner alone is near in a point.
std::uint8_t edge_pseudonormal_side(const PartTriangle& triangle, const Vec3& point, double beyond);

}  // namespace impinge::clash
