// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"
#include "exact/orientation.hpp"

/// Points where faces of triangles meet, exact but for one rounding: each coordinate is the double nearest to the exact
/// one (ties to even; below 2^-1022, where doubles lose digits, it may be rounded twice). Points that are equal exactly
/// are therefore equal bit for bit, whatever edges and planes they were made from.
namespace impinge::clash {

/// The point in which an edge passes through a plane. The edge's ends lie strictly on either side.
Vec3 where_through(const Segment& edge, const Triangle& plane);

/// The point in which two edges in one plane cross. Each has its ends strictly on either side of the other's line. `p`
/// is a projection injective on the plane.
Vec3 where_across(const Segment& edge, const Segment& other, const exact::Projection& p);

}  // namespace impinge::clash
