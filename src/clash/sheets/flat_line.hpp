// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "clash/sheets/half_planes.hpp"
#include "core/vec3.hpp"

/// The common pieces of triangles along a line if all of them lie in one plane: there are two half-planes, and edges
/// along the line end in vertices, so that no rational numbers are needed.
namespace impinge::clash {

/// Of one of two parts' triangles. Places along the line are exact.
struct EdgeOnLine {
  double lo, hi;
  std::uint32_t triangle;
  bool is_first;  ///< of the parts
  bool is_left;   ///< in which of the two half-planes its triangle is
};

/// Nothing if no edge of the proper triangle, which lies in a plane with the line, runs along it between its points.
std::optional<EdgeOnLine> edge_on_line(const Line& line, const Triangle& t, std::uint32_t triangle, bool is_first);

/// For each piece of the line along which both parts have an edge in both half-planes: the first part's triangles.
std::vector<std::vector<std::uint32_t>> where_all_meet(const std::vector<EdgeOnLine>& edges);

}  // namespace impinge::clash
