// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "impinge/contacts.hpp"
#include "solid/cells.hpp"

namespace impinge::clash {

/// A part with what is looked up of it again and again.
struct LinkedPart {
  solid::Part part;
  solid::Fans fans;
};

/// Where the boundaries of two parts lie to each other, to within a tolerance: kNear is what is certainly no farther
/// than that from the other's boundary; kInside and kOutside stand for points that are farther, or not certainly near.
/// Of a part that is not solid there is no inside: all that is not near is kOutside.
///
/// `near` holds at least all pairs of triangles (a, b) whose distance is at most `tolerance`, sorted by a. Stops early
/// once `enough(cells)`. Nothing where floating point cannot tell apart what it must, or a shell is no boundary.
std::optional<solid::Cells> near_cells(const LinkedPart& a, const LinkedPart& b, double tolerance,
                                       const std::vector<TrianglePair>& near, const solid::Enough& enough);

}  // namespace impinge::clash
