// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "clash/kd_tree.hpp"
#include "clash/sheets/common_corners.hpp"
#include "core/vec3.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

/// Finds the corners of some triangles of a part that lie on the edges of others (T-junctions). Edges are cut there, so
/// that surfaces along one line have whole edges in common, however they were triangulated.
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

  static std::vector<Corner> corners_of(const solid::Part& part, const std::vector<std::uint32_t>& ids);
  [[nodiscard]] const Corner& corner(std::uint32_t position) const;

  CornerReach reach_;
  double rounding_;
  std::vector<Corner> corners_;  ///< sorted by position
  KdTree tree_;                  ///< over them
};

}  // namespace impinge::clash
