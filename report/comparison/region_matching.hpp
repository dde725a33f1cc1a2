// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "impinge/regions.hpp"
#include "report/comparison/standing.hpp"

namespace impinge::report {

/// A region of the previous run, whether it was there then or had been resolved.
struct EarlierRegion {
  std::string id;
  Point centroid;
  double reach;
  const Remark* remark;
};

/// For each new region the number of the earlier one that it is, or nothing; the nearest two first, as far as half the
/// diagonals of both boxes and `slack` reach. Of more than 2,000 that moved the rest are
/// looked at no more.
std::vector<std::optional<std::size_t>> match_regions(const std::vector<Region>& regions,
                                                      const std::vector<bool>& is_taken,
                                                      const std::vector<EarlierRegion>& earlier, double slack);

/// Ids for regions that have none: the first numbers that no other region of the pair has, or had.
void name_regions(const std::string& pair, std::unordered_set<std::string> used, std::vector<RegionStanding>& regions);

}  // namespace impinge::report
