// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "schedule/ways.hpp"

#include <algorithm>
#include <limits>

namespace impinge::schedule {
namespace {

/// A way that is not taken is forgotten slowly, so that one measured in a bad moment is tried again: one that takes
/// twice as long as the best after 350 queries. One that took kHopeless times as long is not.
constexpr double kForgotten = 0.998, kHopeless = 8;

}  // namespace

double Ways::seconds(Way way, const WaySeconds& expected) const {
  const auto i = static_cast<std::size_t>(way);
  return tried_[i].seconds > 0 ? tried_[i].seconds : expected[i];
}

Way Ways::quickest(const WaySeconds& expected) const {
  double best = std::numeric_limits<double>::infinity();
  for (const Tried& way : tried_)
    if (way.seconds > 0) best = std::min(best, way.seconds);
  WaySeconds all{};
  for (std::size_t i = 0; i < kWays; ++i) {
    const Tried& way = tried_[i];
    const bool is_hopeless = way.seconds > kHopeless * best;
    all[i] = way.seconds > 0 ? way.seconds * (is_hopeless ? 1 : way.remembered) : 0.5 * expected[i];
  }
  return static_cast<Way>(std::min_element(all.begin(), all.end()) - all.begin());
}

void Ways::add(Way way, const Statistics& counts, double seconds, bool is_typical) {
  last_ = counts, last_seconds_ = seconds;
  if (!is_typical) return;
  for (Tried& other : tried_) other.remembered *= kForgotten;
  Tried& taken = tried_[static_cast<std::size_t>(way)];
  taken = {taken.seconds > 0 ? 0.5 * (taken.seconds + seconds) : seconds, 1};
}

}  // namespace impinge::schedule
