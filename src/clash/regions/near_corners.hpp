// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "clash/regions/shared_parts.hpp"
#include "core/disjoint_sets.hpp"

namespace impinge::clash {

/// Joins pairs with corners no farther apart than the tolerance.
void join_near_corners(const SharedParts& parts, std::size_t contacts, double tolerance, DisjointSets& groups);

}  // namespace impinge::clash
