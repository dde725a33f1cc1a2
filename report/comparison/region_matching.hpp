// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "impinge/regions.hpp"
#include "report/comparison/previous.hpp"
#include "report/comparison/standing.hpp"

namespace impinge::report {

/// For each region the index of the earlier one that it is, or nothing; the nearest two first, as far as half the
/// diagonals of both boxes and `slack` reach. Of more than 2,000 regions that moved, the rest are not compared.
std::vector<std::optional<std::size_t>> match_regions(const std::vector<Region>& regions,
                                                      const std::vector<Previous::OldRegion>& earlier, double slack);

/// Gives ids to regions that have none: made of the pair's id and the first numbers that give no id in `taken`.
void name_regions(const std::string& pair, std::unordered_set<std::string> taken, std::vector<RegionStanding>& regions);

}  // namespace impinge::report
