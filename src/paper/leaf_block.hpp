// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh_data.hpp"

namespace impinge::paper {

/// An edge between two of a block's vertices and the one or two of its triangles that have it.
struct LeafEdge {
  static constexpr std::uint16_t kNone = 0xFFFF;
  std::uint16_t from, to;
  std::uint16_t left, right;
};

/// The triangles of a leaf, with what they share counted once: what the narrow phase streams.
struct LeafBlock {
  std::vector<std::uint32_t> triangles;               ///< mesh triangle ids
  std::vector<std::uint32_t> vertices;                ///< mesh vertex ids
  std::vector<std::array<std::uint16_t, 3>> corners;  ///< of each triangle, into `vertices`
  std::vector<LeafEdge> edges;                        ///< at least every edge of every triangle
};

LeafBlock make_leaf_block(const MeshData& mesh, std::span<const std::uint32_t> triangles);

/// Two leaves whose boxes may overlap.
struct LeafPair {
  const LeafBlock* a;
  const LeafBlock* b;
};

using LeafPairs = std::vector<LeafPair>;

}  // namespace impinge::paper
