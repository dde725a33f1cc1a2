// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <stop_token>

#include "clash/regions/shared_parts.hpp"

namespace impinge::clash {

/// The distance up to which corners are welded: far above rounding, and above the distance between the corners that
/// different pairs have for one place in a gap (on one face, on the other, or half-way between them, along one normal
/// or another). In a gap as wide as the triangles, neighbouring normals must differ by little, or corners stay apart.
double welding_distance(const SharedParts& parts, const Reach& reach);

/// Welds corners: each is moved onto the first point, in lexicographic order, that was kept within the welding
/// distance. Corners that exact parts have in common are common to parts within a tolerance too, then. Each corner gets
/// the edges to which it is near.
SharedParts welded(const solid::Body& a, const solid::Body& b, std::span<const exact::Contact> contacts,
                   const SharedParts& parts, const Reach& reach, const std::stop_token& stop);

}  // namespace impinge::clash
