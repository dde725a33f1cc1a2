// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/near_corners.hpp"

#include <cmath>
#include <unordered_map>
#include <vector>

#include "clash/point_grid.hpp"
#include "core/shapes.hpp"

namespace impinge::clash {
namespace {

struct Entry {
  Vec3 point;
  std::uint32_t contact;
};
/// Points no farther apart than the tolerance.
struct Cell {
  std::vector<Entry> entries;
  Box box{};
};
using Cells = std::unordered_map<Vec3, Cell, PointHash>;

/// Of the cube's side, so that its diagonal is a little less than the tolerance.
constexpr double kCellsPerTolerance = 1.75;

Vec3 cell_of(const Vec3& p, double tolerance) {
  const auto index = [&](double x) { return std::floor(kCellsPerTolerance * (x / tolerance)) + 0.0; };  // no -0
  return {index(p.x), index(p.y), index(p.z)};
}

/// Many corners within one tolerance must not be compared each with each.
Cells make_cells(const SharedParts& parts, std::size_t contacts, double tolerance, DisjointSets& groups) {
  std::unordered_map<Vec3, std::uint32_t, PointHash> first;
  Cells cells;
  for (std::uint32_t i = 0; i < contacts; ++i)
    for (const Corner& corner : parts[i]) {
      const Vec3& p = corner.point;
      if (!first.try_emplace(p, i).second) continue;
      Cell& cell = cells[cell_of(p, tolerance)];
      if (cell.entries.empty()) cell.box = {p, p};
      cell.box = {min(cell.box.lo, p), max(cell.box.hi, p)};
      cell.entries.push_back({p, i});
      groups.join(cell.entries.front().contact, i);
    }
  return cells;
}

/// Half of the cells that come within the tolerance of one: the other half has it in its own.
std::vector<Vec3> ways_to_neighbours() {
  std::vector<Vec3> ways;
  for (int i = 63; i < 125; ++i)
    ways.push_back(
        {static_cast<double>(i / 25 - 2), static_cast<double>(i / 5 % 5 - 2), static_cast<double>(i % 5 - 2)});
  return ways;
}

bool are_near(const Cell& x, const Cell& y, double tolerance) {
  const auto is_within = [&](const Vec3& way) { return norm((1 / tolerance) * way) <= 1; };
  const Vec3 gap = max(max(x.box.lo - y.box.hi, y.box.lo - x.box.hi), Vec3{0, 0, 0});
  if (!is_within((1 - 0x1p-40) * gap)) return false;
  for (const Entry& p : x.entries)
    for (const Entry& q : y.entries)
      if (is_within(q.point - p.point)) return true;
  return false;
}

}  // namespace

void join_near_corners(const SharedParts& parts, std::size_t contacts, double tolerance, DisjointSets& groups) {
  const Cells cells = make_cells(parts, contacts, tolerance, groups);
  const std::vector<Vec3> ways = ways_to_neighbours();
  for (const auto& [at, cell] : cells)
    for (const Vec3& way : ways) {
      const auto other = cells.find(at + way);
      if (other == cells.end()) continue;
      const std::uint32_t one = cell.entries.front().contact, two = other->second.entries.front().contact;
      if (groups.find(one) != groups.find(two) && are_near(cell, other->second, tolerance)) groups.join(one, two);
    }
}

}  // namespace impinge::clash
