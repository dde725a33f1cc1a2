// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>

#include "core/shapes.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

/// The distance within which a corner is on an edge, or equal to another corner.
struct CornerReach {
  CornerReach(const solid::Part& part, double tolerance);
  /// To edges that are short beside the tolerance all around is near: on them is what is so but for rounding.
  [[nodiscard]] double beside(double length) const;

  double tolerance, noise;
};

/// Welds the corners on the borders of some triangles: the two sides of a seam need not have equal vertices.
class CommonCorners {
 public:
  struct Edge {
    std::uint32_t from, to;  ///< positions
    Segment at;
    bool is_border;  ///< of one triangle alone
  };
  CommonCorners(std::span<const Edge> edges, const CornerReach& reach);

  /// The position that stands for it.
  [[nodiscard]] std::uint32_t of(std::uint32_t position) const {
    const auto found = stands_.find(position);
    return found == stands_.end() ? position : found->second;
  }

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> stands_;  ///< of those that another one stands for
};

}  // namespace impinge::clash
