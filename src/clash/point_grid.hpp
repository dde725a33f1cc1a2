// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/point_table.hpp"
#include "core/shapes.hpp"
#include "core/stopped.hpp"

namespace impinge::clash {

/// Numbered points in cubic cells of a regular grid; only cells with points take memory.
class PointGrid {
 public:
  struct Cell {
    Box box;                    ///< of the points
    std::uint32_t first, last;  ///< entries
  };

  explicit PointGrid(double cell_size) : cell_size_(cell_size) {}

  /// Returns the point's cell, which is good until the next call.
  const Cell& add(const Vec3& point, std::uint32_t number) {
    const std::uint32_t at = indices_.add(index_of(point)), entry = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({point, number, kNone});
    if (at == cells_.size()) return cells_.emplace_back(Cell{{point, point}, entry, entry});
    Cell& cell = cells_[at];
    cell.box = {min(cell.box.lo, point), max(cell.box.hi, point)};
    entries_[cell.last].next = entry;
    cell.last = entry;
    return cell;
  }
  [[nodiscard]] std::uint32_t first_number(const Cell& cell) const { return entries_[cell.first].number; }

  /// Calls visit(point, number) for each point of a cell, in the order in which they came, until it returns true;
  /// whether it did.
  template <class Visit>
  bool any_of(const Cell& cell, const Visit& visit) const {
    for (std::uint32_t i = cell.first; i != kNone; i = entries_[i].next)
      if (visit(entries_[i].point, entries_[i].number)) return true;
    return false;
  }

  /// The same for each point no farther than a cell's size from this one.
  template <class Visit>
  void find(const Vec3& point, const Visit& visit) const {
    const Vec3 middle = index_of(point);
    const auto visit_near = [&](const Vec3& other, std::uint32_t number) {
      return norm((1 / cell_size_) * (other - point)) <= 1 && visit(other, number);
    };
    for (const double x : {-1.0, 0.0, 1.0})
      for (const double y : {-1.0, 0.0, 1.0})
        for (const double z : {-1.0, 0.0, 1.0}) {
          const auto cell = indices_.find(middle + Vec3{x, y, z});
          if (cell && any_of(cells_[*cell], visit_near)) return;
        }
  }

  /// Calls visit(one, other) for each two cells that are one of the steps apart, in cells along the axes. Throws
  /// `Stopped`.
  template <class Visit>
  void for_each_pair(const std::vector<Vec3>& steps, const std::stop_token& stop, const Visit& visit) const {
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
      throw_if_stopped(stop);
      for (const Vec3& step : steps)
        if (const auto other = indices_.find(indices_.points()[i] + step)) visit(cells_[i], cells_[*other]);
    }
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  struct Entry {
    Vec3 point;
    std::uint32_t number, next;
  };

  [[nodiscard]] Vec3 index_of(const Vec3& p) const {
    const auto index = [&](double x) { return std::floor(x / cell_size_); };
    return {index(p.x), index(p.y), index(p.z)};
  }

  double cell_size_;
  PointTable indices_;  ///< of cells, along the three axes
  std::vector<Cell> cells_;
  std::vector<Entry> entries_;
};

}  // namespace impinge::clash
