// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "clash/near_cells.hpp"
#include "exact/contact.hpp"

namespace impinge::clash {

/// Whether two surfaces go through each other somewhere, farther than the tolerance on all four sides. A place is a set
/// of near pairs of two connected pieces that hang together by common triangles; two triangles of it cross, each
/// surface is there on both sides of the other, and each comes within the other's triangles: an edge that ends on a
/// face, or pokes through it by no more than the tolerance, does not pass. Sides are told apart as far as neighbouring
/// triangles hand them on; a one-sided surface has none. `near` and `contacts` are as in near_cells.
bool pass_through(const LinkedPart& a, const LinkedPart& b, double tolerance, const std::vector<TrianglePair>& near,
                  std::span<const exact::Contact> contacts);

}  // namespace impinge::clash
