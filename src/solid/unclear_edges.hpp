// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solid/inner_points.hpp"
#include "solid/pieces.hpp"

namespace impinge::solid {

/// The open edges beside which it is not clear what is inside. They are found among 128 that are spread by length,
/// where there are more.
struct UnclearEdges {
  double whole_length = 0, length = 0;  ///< of all open edges, and of the unclear ones
  std::uint64_t count = 0;
  std::optional<std::size_t> first{};  ///< in the list of open edges
};

/// Beside an open edge winding is clear if the winding number is within 1/10 of an integer at two points above and
/// below its middle, half of the largest inner radius of its component away. A crack that is narrow beside that radius
/// hardly shows there; at the rim of an opening the number is near 1/2. Without an inner point nothing is clear. A
/// component is a set of triangles that hang together by vertices. Edges and components name triangles by their place
/// in the tree.
UnclearEdges unclear_edges(const InnerSearch& search, std::span<const OpenEdge> edges,
                           std::span<const std::vector<std::uint32_t>> components);

}  // namespace impinge::solid
