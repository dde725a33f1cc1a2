// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/shapes.hpp"

namespace impinge::partition {

/// A set of cells, a bit each.
using Cells = std::uint64_t;

/// A uniform grid over the overlap of two leaves (section 3.5 of the paper). Its cells are as large as the mean of the
/// elements' boxes, or larger where that would make more than 64 of them.
class Grid {
 public:
  Grid(const Box& region, const Vec3& cell_size);

  /// The cells that a box meets, none if it misses the region. Two boxes that meet within the region share a cell: the
  /// index of a coordinate is a monotone function even in floating point, so both ranges hold that of a common
  /// coordinate.
  [[nodiscard]] Cells cells_of(const Box& box) const;

 private:
  struct Axis {
    double lo, hi, cells_per_length;
    int count;
    [[nodiscard]] int cell(double x) const;
  };
  std::array<Axis, 3> axes_;
};

}  // namespace impinge::partition
