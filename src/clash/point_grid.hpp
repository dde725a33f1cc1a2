// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/hash.hpp"
#include "core/shapes.hpp"

namespace impinge::clash {

struct PointHash {
  std::size_t operator()(const Vec3& p) const { return mix(mix(number_bits(p.x), number_bits(p.y)), number_bits(p.z)); }
};

/// Numbered points in cubic cells of a regular grid; only cells with points take memory.
class PointGrid {
 public:
  struct Entry {
    Vec3 point;
    std::uint32_t number;
  };
  struct Cell {
    std::vector<Entry> entries;
    Box box{};  ///< of the points
  };
  using Cells = std::unordered_map<Vec3, Cell, PointHash>;  ///< by a cell's three indices

  explicit PointGrid(double cell_size) : cell_size_(cell_size) {}

  /// Returns the point's cell.
  Cell& add(const Vec3& point, std::uint32_t number) {
    Cell& cell = cells_[index_of(point)];
    if (cell.entries.empty()) cell.box = {point, point};
    cell.box = {min(cell.box.lo, point), max(cell.box.hi, point)};
    cell.entries.push_back({point, number});
    return cell;
  }
  [[nodiscard]] const Cells& cells() const { return cells_; }

  /// Calls visit(point, number) for each point no farther than a cell's size from this one, until it returns true.
  template <class Visit>
  void find(const Vec3& point, const Visit& visit) const {
    const Vec3 middle = index_of(point);
    for (const double x : {-1.0, 0.0, 1.0})
      for (const double y : {-1.0, 0.0, 1.0})
        for (const double z : {-1.0, 0.0, 1.0}) {
          const auto cell = cells_.find(middle + Vec3{x, y, z});
          if (cell == cells_.end()) continue;
          for (const Entry& entry : cell->second.entries)
            if (norm((1 / cell_size_) * (entry.point - point)) <= 1 && visit(entry.point, entry.number)) return;
        }
  }

 private:
  [[nodiscard]] Vec3 index_of(const Vec3& p) const {
    const auto index = [&](double x) { return std::floor(x / cell_size_); };
    return {index(p.x), index(p.y), index(p.z)};
  }

  double cell_size_;
  Cells cells_;
};

}  // namespace impinge::clash
