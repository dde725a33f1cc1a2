// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impinge/clash.hpp"
#include "report/comparison/previous.hpp"
#include "report/comparison/standing.hpp"

namespace impinge::report {

/// What a review knows of its pairs, as matching needs it.
struct Found {
  const std::vector<Clash>& pairs;
  const std::vector<std::string>& ids;               ///< of the pairs
  const std::vector<bool>& ambiguous;                ///< of the pairs: their ids say what they are, but not which
  std::function<double(const Clash&)> slack;         ///< how far a region may move beyond its own size
  std::function<bool(const Clash&, Verdict)> names;  ///< whether this verdict on the pair would be a failure
  /// Of the pairs of its parts' twins, and itself, the ids that are known.
  std::function<std::vector<std::string>(const Clash&, const std::function<bool(const std::string&)>&)> twins =
      [](const auto&, const auto&) { return std::vector<std::string>(); };
  /// What shape and place its parts have, as `Identity::placed`.
  std::function<std::pair<std::string_view, std::string_view>(const Clash&)> placed = [](const auto&) {
    return std::pair<std::string_view, std::string_view>();
  };
};

/// Ids for the regions of each pair, all of them new if there is no previous run.
std::vector<Standing> stand_alone(const Found& found);

/// What became of the pairs and regions of the previous run; those that are gone are appended to `resolved`. A pair
/// is known by its id. Its regions are matched by their centroids, the nearest two first, as far as half the diagonals
/// of both boxes and the pair's slack reach. What comes back after it was resolved is new; it has its remark
/// if both parts have the shape and place that they had then, as others may have taken their names meanwhile. No remark
/// is given to an ambiguous pair: it is in `resolved`, and says so. A pair that is left of several twins has what was
/// written about them, if that is the same.
std::vector<Standing> compare(const Found& found, const Previous& previous, std::vector<Resolved>& resolved);

}  // namespace impinge::report
