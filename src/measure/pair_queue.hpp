// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "measure/pair_walk.hpp"

namespace impinge::measure {

/// Pairs that wait for their turn, about the nearest first: a stack for each 32nd of the range that they are in. In
/// order to the last digit, as a heap has them, most of the time would go into the order. Of pairs as near as each
/// other, as all are whose boxes overlap, the last that came is first, and so the deepest: not many wait at a time.
class PairQueue {
 public:
  /// For pairs nearer than `limit`, begun with some of them.
  PairQueue(std::span<const NodePair> pairs, double limit) {
    base_ = limit;
    for (const NodePair& pair : pairs) base_ = std::min(base_, pair.lower);
    // As parts of the whole range, so that neither a tiny one nor a huge one leaves the range of numbers.
    per_length_ = limit > base_ ? 1 / (limit - base_) : 0;
    for (const NodePair& pair : pairs) push(pair);
  }

  void push(const NodePair& pair) {
    const double part = (pair.lower - base_) * per_length_ * kStacks;
    const std::size_t i = part > 0 ? static_cast<std::size_t>(std::min(part, kStacks - 1.0)) : 0;
    stacks_[i].push_back(pair);
    first_ = std::min(first_, i);
  }

  /// The next pair, if any is left.
  std::optional<NodePair> pop() {
    while (first_ < kStacks && stacks_[first_].empty()) ++first_;
    if (first_ == kStacks) return std::nullopt;
    const NodePair pair = stacks_[first_].back();
    stacks_[first_].pop_back();
    return pair;
  }

 private:
  static constexpr std::size_t kStacks = 32;
  std::array<std::vector<NodePair>, kStacks> stacks_;
  std::size_t first_ = 0;  ///< below it all are empty
  double base_, per_length_;
};

}  // namespace impinge::measure
