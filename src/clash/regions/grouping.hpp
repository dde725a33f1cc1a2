// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <stop_token>

#include "clash/regions/shared_parts.hpp"
#include "core/disjoint_sets.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

/// Joins pairs with corners no farther apart than the tolerance.
void join_near_corners(const SharedParts& parts, std::size_t contacts, double tolerance, DisjointSets& groups,
                       const std::stop_token& stop);

/// Joins pairs whose triangles are the same or have a position in common in both parts, and pairs that share a corner
/// point.
void join_neighbours(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
                     const SharedParts& parts, DisjointSets& groups, const std::stop_token& stop);

/// Whether a point lies in the interior of a part, farther than the tolerance from its boundary.
using IsInside = std::function<bool(const Vec3&)>;

/// Joins pairs between which a part of the surface of `part` lies inside the other part. `first` says that `part` is
/// the first one of each pair.
void join_through(const solid::Part& part, bool first, std::span<const exact::Contact> contacts,
                  const SharedParts& parts, const IsInside& is_inside, DisjointSets& groups,
                  const std::stop_token& stop);

}  // namespace impinge::clash
