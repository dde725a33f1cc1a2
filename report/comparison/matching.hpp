// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "impinge/clash.hpp"
#include "report/comparison/previous.hpp"
#include "report/comparison/standing.hpp"

namespace impinge::report {

/// What a review knows of its pairs, as matching needs it.
struct Found {
  const std::vector<Clash>& pairs;
  const std::vector<std::string>& ids;               ///< of the pairs
  std::function<double(const Clash&)> slack;         ///< how far a region may move beyond its own size
  std::function<bool(const Clash&, Verdict)> names;  ///< whether this verdict on the pair would be a failure
};

/// Compares the pairs and their regions with those of the previous run, which may be null: then only the regions get
/// their ids. A pair is known by its id. Its regions are matched by their centroids, the nearest two first. Pairs and
/// regions that are gone are appended to `resolved`.
std::vector<Standing> compare(const Found& found, const Previous* previous, std::vector<Resolved>& resolved);

}  // namespace impinge::report
