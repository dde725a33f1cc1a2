// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "partition/grid.hpp"

#include <cmath>

namespace impinge::partition {

Grid::Grid(const Box& region, const Vec3& cell_size) {
  constexpr int kMostCells = 64;
  for (int i = 0; i < 3; ++i) {
    const double lo = component(region.lo, i), hi = component(region.hi, i);
    const double wanted = (hi - lo) / component(cell_size, i);
    axes_[i] = {lo, hi, 0, wanted >= 1 ? static_cast<int>(std::min(wanted, double{kMostCells})) : 1};  // NaN: one cell
  }
  while (axes_[0].count * axes_[1].count * axes_[2].count > kMostCells) {
    Axis* finest = &axes_[0];
    for (Axis& axis : axes_)
      if (axis.count > finest->count) finest = &axis;
    finest->count = (finest->count + 1) / 2;
  }
  for (Axis& axis : axes_) {
    axis.cells_per_length = axis.count / (axis.hi - axis.lo);
    if (axis.count == 1 || !std::isfinite(axis.cells_per_length)) axis.count = 1, axis.cells_per_length = 0;
  }
}

int Grid::Axis::cell(double x) const {
  const double scaled = (x - lo) * cells_per_length;
  return scaled >= count ? count - 1 : scaled > 0 ? static_cast<int>(scaled) : 0;
}

Cells Grid::cells_of(const Box& box) const {
  std::array<int, 3> from, to;
  for (int i = 0; i < 3; ++i) {
    const Axis& axis = axes_[i];
    const double lo = component(box.lo, i), hi = component(box.hi, i);
    if (hi < axis.lo || lo > axis.hi) return 0;
    from[i] = axis.cell(lo), to[i] = axis.cell(hi);
  }
  const Cells row = ((Cells{2} << (to[0] - from[0])) - 1) << from[0];
  Cells cells = 0;
  for (int z = from[2]; z <= to[2]; ++z)
    for (int y = from[1]; y <= to[1]; ++y) cells |= row << (axes_[0].count * (z * axes_[1].count + y));
  return cells;
}

}  // namespace impinge::partition
