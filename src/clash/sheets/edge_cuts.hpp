// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "clash/sheets/common_corners.hpp"
#include "core/vec3.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

/// Where the corners of some triangles of a part lie within the edges of others (T-junctions). Edges are cut there, so
/// that what runs along one line has whole edges in common however it was cut.
class EdgeCuts {
 public:
  EdgeCuts(const solid::Part& part, const std::vector<std::uint32_t>& ids, const CornerReach& reach);

  /// The positions at which the edge between two is cut, these among them: from the one to the other.
  [[nodiscard]] std::vector<std::uint32_t> along(std::uint32_t from, std::uint32_t to) const;
  [[nodiscard]] Vec3 at(std::uint32_t position) const { return corner(position).at; }

 private:
  struct Corner {
    std::uint32_t position;
    Vec3 at;
  };
  /// What of the corners in the tree is near a piece of an edge.
  struct Piece {
    std::uint32_t from, to;  ///< positions
    Segment edge;
    double within;  ///< of the edge a corner is on it; 0: exactly
    Vec3 start, end;
  };
  struct Range {
    std::uint32_t first, last;
  };

  [[nodiscard]] const Corner& corner(std::uint32_t position) const;
  void build(Range range);
  void find(Range range, const Piece& piece, std::vector<std::uint32_t>& found) const;

  CornerReach reach_;
  double rounding_;
  std::vector<Corner> corners_;       ///< sorted
  std::vector<std::uint32_t> order_;  ///< places among the corners: a k-d tree, the middle of each range its root
  std::vector<std::uint8_t> axis_;    ///< of the root in each place
};

}  // namespace impinge::clash
