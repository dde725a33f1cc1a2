// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iterator>
#include <map>
#include <optional>

namespace impinge::gpu {

/// Ranges of a whole that is `size` long, given out where they first fit.
class Ranges {
 public:
  explicit Ranges(std::uint32_t size) : size_(size) { free_[0] = size; }

  /// Where the range begins; nothing if there is no room for it.
  std::optional<std::uint32_t> take(std::uint32_t length) {
    if (length == 0) return 0;
    for (auto range = free_.begin(); range != free_.end(); ++range) {
      const auto [begin, room] = *range;
      if (room < length) continue;
      free_.erase(range);
      if (room > length) free_[begin + length] = room - length;
      return begin;
    }
    return std::nullopt;
  }

  void give_back(std::uint32_t begin, std::uint32_t length) {
    if (length == 0) return;
    auto next = free_.lower_bound(begin);
    if (next != free_.end() && begin + length == next->first) {
      length += next->second;
      next = free_.erase(next);
    }
    if (next != free_.begin()) {
      const auto before = std::prev(next);
      if (before->first + before->second == begin) {
        before->second += length;
        return;
      }
    }
    free_[begin] = length;
  }

  [[nodiscard]] bool all_free() const { return free_.size() == 1 && free_.begin()->second == size_; }

 private:
  std::uint32_t size_;
  std::map<std::uint32_t, std::uint32_t> free_;  ///< length by begin; no two of them adjacent
};

}  // namespace impinge::gpu
