// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "solid/body.hpp"

namespace impinge::solid {

/// How the triangles of a body are connected. Vertices with exactly equal world coordinates (contract 2.7; -0 equals 0)
/// are one position.
struct Topology {
  std::vector<std::uint32_t> position;  ///< per mesh vertex, numbered from 0
  std::uint32_t positions = 0;
  /// Per triangle, its shell: two triangles are in one shell if a path leads from one to the other over edges that
  /// exactly two proper triangles use, one in each direction. The winding number is constant on either side of a shell
  /// of a solid. Shells are numbered in the order of their first triangles; a degenerate triangle has kNoShell.
  std::vector<std::uint32_t> shell;
  std::uint32_t shells = 0;
  /// Edges, by the positions of their ends, that triangles run along more often in one direction than in the other.
  /// Edges of degenerate triangles count like all others.
  std::vector<std::array<std::uint32_t, 2>> open_edges;
  std::uint64_t degenerate = 0;  ///< triangles whose world vertices are collinear
  bool closed = false;           ///< no open edge, and at least one proper triangle

  /// Adjacency, in compressed rows: for each position the triangles that use it, each once and in ascending order.
  std::vector<std::uint32_t> fan_offsets, fan_triangles;

  static constexpr std::uint32_t kNoShell = 0xffffffff;

  [[nodiscard]] bool is_proper(std::uint32_t triangle) const { return shell[triangle] != kNoShell; }

  /// The triangles that use a position.
  [[nodiscard]] std::span<const std::uint32_t> fan(std::uint32_t at) const {
    return std::span(fan_triangles).subspan(fan_offsets[at], fan_offsets[at + 1] - fan_offsets[at]);
  }

  /// The positions of a triangle's corners.
  [[nodiscard]] std::array<std::uint32_t, 3> corners(const Body& body, std::uint32_t triangle) const {
    const auto& [a, b, c] = body.placed.mesh->triangles[triangle];
    return {position[a], position[b], position[c]};
  }
};

Topology examine(const Body& body);

/// A triangle's use of an edge between two positions.
struct EdgeUse {
  std::uint32_t high;      ///< the higher one of the edge's positions
  std::uint32_t triangle;  ///< has the edge from its corner `k` to the next
  std::uint8_t k;
  std::int8_t way;  ///< +1 from the lower position to the higher, -1 back
};
using VisitEdge = std::function<void(std::uint32_t low, std::span<const EdgeUse> uses)>;

/// Visits each edge once, in the order of its positions, with all its uses in the order of their triangles. An edge
/// from a position to itself is left out. Ends early once it is stopped.
void for_each_edge(const Body& body, const Topology& topology, const VisitEdge& visit,
                   const std::stop_token& stop = {});

}  // namespace impinge::solid
