// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "core/for_each.hpp"
#include "exact/contact.hpp"
#include "impinge/regions.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

/// The least tolerance, as a share of the largest coordinate: below it floating point cannot keep points apart.
inline constexpr double kLeastTolerance = 0x1p-36;

/// The regions of contact of two parts (impinge/regions.hpp). `contacts` are all pairs of triangles that share a point
/// or, with a tolerance, all within it; sorted by a and then b. Throws
/// `Stopped`.
std::vector<Region> regions_of(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
                               double tolerance, const ForEach& for_each = {}, const std::stop_token& stop = {});

/// The greatest number of pairs of triangles that are both small beside the tolerance, no edge longer than four of it,
/// for which regions are found. Their number grows with the square of the tolerance, so that it needs a limit, in
/// proportion to the meshes.
std::size_t most_small_pairs(const solid::Body& a, const solid::Body& b);

/// The pairs of triangles within a tolerance above 0; their kinds are not determined. Incomplete if stopped; nothing if
/// in more than `most` pairs both triangles are small.
std::optional<std::vector<exact::Contact>> contacts_within(const solid::Body& a, const solid::Body& b, double tolerance,
                                                           std::size_t most, const std::stop_token& stop = {});

}  // namespace impinge::clash
