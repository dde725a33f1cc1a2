// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace impinge::narrow {

/// What certified floating point says of an edge and a triangle, or of two triangles. In order of precedence: a pair of
/// triangles has the greatest verdict of its tests.
enum class Verdict : std::uint8_t {
  no,        ///< certainly apart
  unsure,    ///< left to exact arithmetic
  crossing,  ///< certainly: the edge passes through the interior of the triangle, with an end strictly on either side
};

}  // namespace impinge::narrow
