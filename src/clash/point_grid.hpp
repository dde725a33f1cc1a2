// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/vec3.hpp"

namespace impinge::clash {

/// Of points of which equal ones are equal bit for bit.
struct PointHash {
  std::size_t operator()(const Vec3& p) const {
    std::uint64_t hash = 0;
    for (const double x : {p.x, p.y, p.z}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

/// Finds points that are no farther from another than a radius: those of the 27 cells around it are looked at.
class PointGrid {
 public:
  explicit PointGrid(double radius) : radius_(radius) {}

  void add(const Vec3& point, std::uint32_t number) { cells_[cell_of(point)].push_back({point, number}); }
  /// Calls visit(point, number) for each point within the radius, until it says true.
  template <class Visit>
  void find(const Vec3& point, const Visit& visit) const {
    const Vec3 middle = cell_of(point);
    for (const double x : {-1.0, 0.0, 1.0})
      for (const double y : {-1.0, 0.0, 1.0})
        for (const double z : {-1.0, 0.0, 1.0}) {
          const auto cell = cells_.find(middle + Vec3{x, y, z});
          if (cell == cells_.end()) continue;
          for (const Entry& entry : cell->second)
            if (norm((1 / radius_) * (entry.point - point)) <= 1 && visit(entry.point, entry.number)) return;
        }
  }

 private:
  struct Entry {
    Vec3 point;
    std::uint32_t number;
  };
  [[nodiscard]] Vec3 cell_of(const Vec3& p) const {
    const auto index = [&](double x) { return std::floor(x / radius_) + 0.0; };  // of the two zeros the positive one
    return {index(p.x), index(p.y), index(p.z)};
  }

  double radius_;
  std::unordered_map<Vec3, std::vector<Entry>, PointHash> cells_;
};

}  // namespace impinge::clash
