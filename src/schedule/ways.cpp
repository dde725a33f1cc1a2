// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "schedule/ways.hpp"

#include <algorithm>

namespace impinge::schedule {
namespace {

/// What queries of one kind differ in; they begin with some work in common.
double work_of(const Statistics& counts) {
  return 1e4 + static_cast<double>(counts.box_tests) + 8 * static_cast<double>(counts.triangle_pairs);
}

/// A way that is not taken is forgotten slowly, so that one measured in a bad moment is tried again: one that takes
/// twice as long as the best after 350 queries.
constexpr double kForgotten = 0.998;

}  // namespace

double Ways::seconds(Way way, const WaySeconds& expected) const {
  const auto i = static_cast<std::size_t>(way);
  return pace_[i] > 0 ? pace_[i] * work_of(last_) : expected[i];
}

Way Ways::quickest(const WaySeconds& expected) const {
  WaySeconds all{};
  for (std::size_t i = 0; i < kWays; ++i) all[i] = (pace_[i] > 0 ? 1 : 0.5) * seconds(static_cast<Way>(i), expected);
  return static_cast<Way>(std::min_element(all.begin(), all.end()) - all.begin());
}

void Ways::add(Way way, const Statistics& counts, double seconds, bool is_typical) {
  last_ = counts, last_seconds_ = seconds;
  if (!is_typical) return;
  for (double& pace : pace_) pace *= kForgotten;
  double& pace = pace_[static_cast<std::size_t>(way)];
  const double now = seconds / work_of(counts);
  pace = pace > 0 ? 0.5 * (pace + now) : now;
}

}  // namespace impinge::schedule
