// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "clash/local_frame.hpp"
#include "clash/near_cells.hpp"

namespace impinge::clash {

/// A triangle of a part, in local coordinates too.
struct PartTriangle {
  const LinkedPart& part;
  const LocalFrame& frame;
  std::uint32_t id;
  Triangle local;
};

/// Whether the surface leaves the triangle's plane by an angle above 2^-6 at one of its edges or corners.
bool is_bent_around(const PartTriangle& triangle);

/// On which side of the surface, as the triangle looks, a point is which has, of all triangles there, its nearest point
/// on an edge or in a corner of this one: before the sum of the normals that meet there, by their angles in a corner,
/// or behind (Baerentzen and Aanaes, Signed distance computation using the angle weighted pseudonormal, 2005).
///
/// 0 for all other points and those that are no farther than `beyond`; also where the surface ends or branches, where
/// it is folded up flat or a normal is not known well enough, and in corners of very many triangles.
std::uint8_t side_of_fold(const PartTriangle& triangle, const Vec3& point, double beyond);

}  // namespace impinge::clash
