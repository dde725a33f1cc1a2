// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/flat_line.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "exact/segment.hpp"

namespace impinge::clash {

std::optional<EdgeOnLine> edge_on_line(const Line& line, const Triangle& t, std::uint32_t triangle, bool is_first) {
  const exact::Projection& projection =
      exact::kProjections[static_cast<std::size_t>(exact::find_projection(t[0], t[1], t[2]))];
  std::array<int, 3> side{};
  for (std::size_t i = 0; i < 3; ++i) side[i] = exact::orient2d(projection, line.from(), line.to(), t[i]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (side[i] != 0 || side[j] != 0) continue;
    const double p = line.place(t[i]), q = line.place(t[j]);
    const double lo = std::max(std::min(p, q), line.place(line.from()));
    const double hi = std::min(std::max(p, q), line.place(line.to()));
    if (lo < hi) return EdgeOnLine{lo, hi, triangle, is_first, side[k] > 0};
  }
  return std::nullopt;
}

std::vector<std::vector<std::uint32_t>> where_all_meet(const std::vector<EdgeOnLine>& edges) {
  std::vector<double> ends;
  for (const EdgeOnLine& edge : edges) ends.push_back(edge.lo), ends.push_back(edge.hi);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<std::vector<std::uint32_t>> all;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    std::vector<std::uint32_t> of_first;
    unsigned met = 0;
    for (const EdgeOnLine& edge : edges) {
      if (edge.lo > ends[i] || edge.hi < ends[i + 1]) continue;
      met |= 1U << (2 * int{edge.is_first} + int{edge.is_left});
      if (edge.is_first) of_first.push_back(edge.triangle);
    }
    if (met == 15) all.push_back(std::move(of_first));
  }
  return all;
}

}  // namespace impinge::clash
