// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "impinge/clash.hpp"
#include "solid/body.hpp"
#include "solid/classed_piece.hpp"
#include "solid/topology.hpp"

namespace impinge::solid {

/// What a body is by winding numbers.
struct Classification {
  PartClass best = PartClass::surface;  ///< of its pieces
  std::vector<ClassedPiece> pieces{};
  std::uint64_t turned = 0;         ///< triangles that were turned to agree with others, or to wind positively
  std::uint64_t unclear_edges = 0;  ///< open edges, of turned triangles, beside which winding is not clear
  std::optional<std::array<std::uint32_t, 2>> unclear_edge{};  ///< the mesh vertices of the first of them

  /// How many pieces there are of each class.
  [[nodiscard]] std::array<std::uint32_t, 3> counts() const {
    std::array<std::uint32_t, 3> counts{};
    for (const ClassedPiece& piece : pieces) ++counts[static_cast<std::size_t>(piece.part_class)];
    return counts;
  }
};

/// Once it is stopped, the result is meaningless.
Classification classify(const Body& body, const Topology& topology, const std::stop_token& stop = {});

}  // namespace impinge::solid
