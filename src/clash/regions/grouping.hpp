// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "clash/regions/shared_parts.hpp"
#include "core/disjoint_sets.hpp"

namespace impinge::clash {

/// Joins pairs whose triangles are the same or neighbours (have a position in common) in either body, and pairs that
/// share a corner point.
void join_neighbours(const Side& a, const Side& b, std::span<const exact::Contact> contacts, const SharedParts& parts,
                     DisjointSets& groups);

/// Joins pairs between which a part of `side`'s surface lies inside `other`. `first` says that `side` is the pairs' a.
void join_through(const Side& side, const Side& other, bool first, std::span<const exact::Contact> contacts,
                  const SharedParts& parts, DisjointSets& groups);

}  // namespace impinge::clash
