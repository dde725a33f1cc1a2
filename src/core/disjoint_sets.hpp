// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace impinge {

/// Sets that are joined two by two. A set's name is its lowest member, in whatever order it was put together.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size = 0) { restart(size); }
  /// Each member by itself again.
  void restart(std::size_t size) {
    parent_.resize(size);
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Returns the joined set's name.
  std::uint32_t join(std::uint32_t i, std::uint32_t j) {
    i = find(i), j = find(j);
    return parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace impinge
