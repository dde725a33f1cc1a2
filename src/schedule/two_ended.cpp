// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "schedule/two_ended.hpp"

#include <algorithm>

namespace impinge::schedule {

TwoEnded::TwoEnded(const std::vector<double>& weights) : sums_(1, 0.0), end_(weights.size()) {
  for (const double weight : weights) sums_.push_back(sums_.back() + weight);
}

TwoEnded::Range TwoEnded::take_front(double weight) {
  const std::lock_guard lock(mutex_);
  const std::size_t begin = begin_;
  while (begin_ < end_ && sums_[begin_] - sums_[begin] < weight) ++begin_;
  return {begin, begin_, sums_[begin_] - sums_[begin]};
}

TwoEnded::Range TwoEnded::take_back(double weight) {
  const std::lock_guard lock(mutex_);
  const std::size_t end = end_;
  while (begin_ < end_ && sums_[end] - sums_[end_] < weight) --end_;
  return {end_, end, sums_[end] - sums_[end_]};
}

double TwoEnded::left() const {
  const std::lock_guard lock(mutex_);
  return sums_[end_] - sums_[begin_];
}

}  // namespace impinge::schedule
