// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "impinge/mesh.hpp"
#include "report/review.hpp"
#include "report/vector.hpp"

namespace impinge::report {

/// Where a clash is.
struct Place {
  Point at{};            ///< a point to look at
  Bounds box;            ///< what is to be seen
  bool is_found = true;  ///< false: no point of the clash is known, and `at` is in the middle of what the boxes share
};

/// That of a pair of the review: its regions of contact, the centroid of the largest one; without contact its nearest
/// points; of a part inside another that part; or else what their boxes share. The boxes are `boxes_of` the review.
Place place_of(const Review& review, std::span<const Bounds> boxes, std::size_t pair);

/// For each pair the axes that cross by its place, as `GridNames` and in the storeys of its parts; none without grids,
/// or where no place is found. After a stop some are missing.
/// Adds a warning for each grid that names nothing.
std::vector<std::string> axes_of(Review& review);

/// For each object the box of all of it in the world; empty without triangles, and for some objects after a stop.
std::vector<Bounds> boxes_of(const Review& review);

}  // namespace impinge::report
