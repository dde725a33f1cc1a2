// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "solid/part.hpp"

namespace impinge::solid {

/// Where the points of a degenerate triangle of a part that is no solid, a segment or a point, are to another part:
/// bits as in Cells. `touching` are the other's triangles that share a point with it, all of them.
std::uint8_t cells_of_degenerate(const Triangle& degenerate, const Part& other,
                                 const std::vector<std::uint32_t>& touching);

}  // namespace impinge::solid
