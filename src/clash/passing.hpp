// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "clash/near_cells.hpp"

namespace impinge::clash {

/// Whether two surfaces go through each other somewhere, farther than the tolerance on all four sides. A place is a set
/// of near pairs of two connected pieces that hang together by common triangles; two triangles of it cross, each
/// surface is there on both sides of the other, and each comes within the other's triangles: an edge that ends on a
/// face, or pokes through it by no more than the tolerance, does not pass. Sides are told apart as far as neighbouring
/// triangles hand them on; a one-sided surface has none. `encounter` is as in near_cells.
bool pass_through(const LinkedPart& a, const LinkedPart& b, double tolerance, const Encounter& encounter,
                  const std::stop_token& stop);

}  // namespace impinge::clash
