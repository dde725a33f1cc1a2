// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "clash/contact_pairs.hpp"
#include "solid/cells.hpp"

namespace impinge::clash {

/// Where the boundary of each of two parts lies in the other, within a tolerance: kNear stands for points certainly no
/// farther than that from the other boundary, kInside and kOutside for all others. A part that is not solid has no
/// inside: all points that are not near it are kOutside.
///
/// Stops early once `enough(cells)`. Nothing where the tolerance is too small for floating point, a part has internal
/// walls, or a stop was requested.
struct CellsWithinSearch {
  double tolerance;
  const ContactPairs& contact_pairs;  ///< of the two parts, within the tolerance
  solid::Enough enough;
  std::stop_token stop{};
};
std::optional<solid::Cells> cells_within(const solid::Part& a, const solid::Part& b, const CellsWithinSearch& search);

}  // namespace impinge::clash
