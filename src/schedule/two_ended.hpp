// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

namespace impinge::schedule {

/// Pieces of work in a row, which two sides take from its two ends until they meet. Safe from many threads.
class TwoEnded {
 public:
  struct Range {
    std::size_t begin, end;
    double weight;
    [[nodiscard]] bool empty() const { return begin == end; }
  };

  /// What each piece weighs: above 0.
  explicit TwoEnded(const std::vector<double>& weights);

  /// Pieces that together weigh at least so much, or all that are left; none if `weight` is not above 0.
  Range take_front(double weight);
  Range take_back(double weight);

  /// What the pieces weigh that nobody has taken.
  [[nodiscard]] double left() const;
  /// What all pieces weigh.
  [[nodiscard]] double total() const { return sums_.back(); }

 private:
  mutable std::mutex mutex_;
  std::vector<double> sums_;  ///< of the pieces before each
  std::size_t begin_ = 0, end_;
};

}  // namespace impinge::schedule
