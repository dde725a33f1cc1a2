// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "impinge/mesh.hpp"
#include "report/review.hpp"
#include "report/vector.hpp"

namespace impinge::report {

/// Where a clash is.
struct Place {
  Point at{};  ///< a point to look at
  Bounds box;  ///< what is to be seen
};

/// That of a pair of the review: its regions of contact, the centroid of the largest one; without contact its nearest
/// points; or else what their boxes share, which of a part inside another is that part.
Place place_of(const Review& review, std::size_t pair);

/// For each pair the axes that cross by its place, as `GridNames` and in the storeys of its parts; none without grids.
std::vector<std::string> axes_of(const Review& review);

/// All of an object in the world; empty without triangles.
Bounds bounds_of(const io::Object& object);

}  // namespace impinge::report
