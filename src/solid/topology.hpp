// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solid/body.hpp"

namespace impinge::solid {

/// How a body's triangles hang together. Vertices are identified by exactly equal world coordinates (contract 2.7; -0
/// equals 0): a position.
struct Topology {
  std::vector<std::uint32_t> position;  ///< per mesh vertex, numbered from 0
  std::uint32_t positions = 0;
  /// Per triangle: its shell. Two triangles are in one shell if a way leads from one to the other over edges that
  /// exactly two proper triangles use, one each way. The two sides of a shell of a solid see one winding number each.
  /// Numbered in the order of their first triangles; kNoShell where a triangle is degenerate.
  std::vector<std::uint32_t> shell;
  std::uint32_t shells = 0;
  /// Edges (by position) that are not run through as often one way as the other, by the positions of their ends. A
  /// degenerate triangle's edges count as any other's.
  std::vector<std::array<std::uint32_t, 2>> open_edges;
  std::uint64_t degenerate = 0;  ///< triangles whose world vertices are collinear
  bool closed = false;           ///< no open edge, and at least one proper triangle

  static constexpr std::uint32_t kNoShell = 0xffffffff;
};

Topology examine(const Body& body);

/// For each position, the triangles that use it, each once and in order, in compressed rows.
struct Fans {
  std::vector<std::uint32_t> offsets, triangles;
};
Fans fans_of(const Body& body, const Topology& topology);

}  // namespace impinge::solid
