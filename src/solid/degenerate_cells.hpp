// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "solid/part.hpp"

namespace impinge::solid {

/// Where the points of a surface's degenerate triangle, which is a segment or a point, lie in another part: bits as in
/// Cells. `touching` are all triangles of the other part that share a point with it.
std::uint8_t cells_of_degenerate(const Triangle& degenerate, const Part& other,
                                 const std::vector<std::uint32_t>& touching);

}  // namespace impinge::solid
