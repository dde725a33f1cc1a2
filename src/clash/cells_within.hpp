// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "clash/contact_pairs.hpp"
#include "solid/cells.hpp"

namespace impinge::clash {

/// Where the boundaries of two parts lie to each other, to within a tolerance: kNear is what is certainly no farther
/// than that from the other's boundary; kInside and kOutside stand for points that are farther, or not certainly near.
/// Of a part that is not solid there is no inside: all that is not near is kOutside.
///
/// Stops early once `enough(cells)`. Nothing where floating point cannot tell apart what it must, a shell is no
/// boundary, or it was asked to stop.
struct CellsWithinSearch {
  double tolerance;
  const ContactPairs& contact_pairs;  ///< of the two, within the tolerance
  solid::Enough enough;
  std::stop_token stop{};
};
std::optional<solid::Cells> cells_within(const solid::Part& a, const solid::Part& b, const CellsWithinSearch& search);

}  // namespace impinge::clash
