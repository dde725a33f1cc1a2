// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "partition/leaf_cells.hpp"

#include <algorithm>

namespace impinge::partition {
namespace {

template <std::size_t N>
Box box_of(const float (&boxes)[6][N], std::size_t i) {
  return {{boxes[0][i], boxes[2][i], boxes[4][i]}, {boxes[1][i], boxes[3][i], boxes[5][i]}};
}

Box hull(const Box& a, const Box& b) { return {min(a.lo, b.lo), max(a.hi, b.hi)}; }

}  // namespace

void map_to_cells(SweepState& s) {
  const auto& member = s.group[s.next_pair - 1];
  const std::size_t count = s.pairs[s.next_pair - 1].a->count;
  const std::span<const std::uint32_t> rows(s.rows + member.first_row, s.rows + member.end_row);
  Box all_a = box_of(s.box_a, 0), all_b = box_of(s.box_b, rows[0]);
  for (std::size_t i = 0; i < count; ++i) all_a = hull(all_a, box_of(s.box_a, i));
  for (const std::uint32_t row : rows) all_b = hull(all_b, box_of(s.box_b, row));
  const Box region = intersection(all_a, all_b);

  Vec3 total{0, 0, 0};
  std::size_t elements = 0;
  const auto add = [&](const Box& box) {
    if (overlap(box, region)) total = total + (box.hi - box.lo), ++elements;
  };
  for (std::size_t i = 0; i < count; ++i) add(box_of(s.box_a, i));
  for (const std::uint32_t row : rows) add(box_of(s.box_b, row));

  std::fill_n(s.cells_a, SweepState::kMostInLeaf, Cells{0});
  if (is_empty(region)) return;
  const Grid grid(region, 1.0 / static_cast<double>(std::max<std::size_t>(elements, 1)) * total);
  for (std::size_t i = 0; i < count; ++i) s.cells_a[i] = grid.cells_of(box_of(s.box_a, i));
  for (const std::uint32_t row : rows) s.cells_b[row] = grid.cells_of(box_of(s.box_b, row));
}

}  // namespace impinge::partition
