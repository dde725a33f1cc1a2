// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "clash/regions/shared_parts.hpp"

namespace impinge::clash {

/// Up to which distance corners of parts within a tolerance are taken to be one: far above rounding, and above what
/// parts points in a gap: those on one face, on the other and half-way between, as seen along one normal or another.
/// In a gap as wide as the triangles are normals differ by little from one to the next, or corners stay apart.
double welding_distance(const SharedParts& parts, const Reach& reach);

/// The parts with corners that are no farther than the snapping distance from one chosen before them moved onto it:
/// what exact parts have in common, near ones have up to rounding and gaps. Points are chosen in lexicographic order.
/// Corners get the edges that they are near.
SharedParts welded(const solid::Body& a, const solid::Body& b, std::span<const exact::Contact> contacts,
                   const SharedParts& parts, const Reach& reach);

}  // namespace impinge::clash
