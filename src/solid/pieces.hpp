// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "solid/body.hpp"
#include "solid/orientation.hpp"
#include "solid/topology.hpp"

namespace impinge::solid {

/// Some of a body's triangles that are one body of their own.
struct Piece {
  std::vector<std::uint32_t> triangles;  ///< ascending
  bool closed = false;                   ///< each edge is run through as often one way as the other
};

/// What hangs together by vertices and is closed is a piece, with the closed patches within it; all that is not closed
/// is one piece more, the last, with segments and points that hang on nothing closed. Pieces are in the order of their
/// first triangles. Incomplete once it is stopped.
std::vector<Piece> pieces_of(const Body& body, const Topology& topology, const Orientation& orientation,
                             const std::stop_token& stop);

/// An edge that is not run through as often one way as the other, as its first triangle has it.
struct OpenEdge {
  std::uint32_t triangle;
  std::uint8_t k;  ///< from the triangle's corner `k` to the next
};
std::vector<OpenEdge> open_edges_of(const Body& body, const Topology& topology, const Orientation& orientation,
                                    const std::stop_token& stop);

/// What of these triangles hangs together by vertices, in the order of the first triangles.
std::vector<std::vector<std::uint32_t>> components_of(const Body& body, const Topology& topology,
                                                      std::span<const std::uint32_t> triangles);

}  // namespace impinge::solid
