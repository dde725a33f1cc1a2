// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "schedule/cost.hpp"

#include <algorithm>

namespace impinge::schedule {

CostConstants constants_from(const CostRuns& light, const CostRuns& deep, const Statistics& touching) {
  const auto per = [](double seconds, std::uint64_t count) {
    return std::max(seconds, 0.0) / static_cast<double>(std::max<std::uint64_t>(count, 1));
  };
  const auto making = [](const CostRuns& runs) {
    return std::max(runs.building.hierarchy_seconds - runs.repeated.hierarchy_seconds, 0.0);
  };
  CostConstants constants{
      .box_test = per(deep.repeated.hierarchy_seconds, deep.repeated.box_tests),
      .element_test = per(deep.repeated.narrow_seconds, deep.repeated.element_tests),
      .leaf_pair = per(deep.repeated.partition_seconds, deep.repeated.leaf_pairs),
      .exact_call = per(touching.exact_seconds, touching.exact_calls),
  };
  // A light query's nodes are few and large, a deep one's many and small: two equations for C_u and C_t.
  const auto n = [](const CostRuns& runs) { return static_cast<double>(runs.building.nodes_built); };
  const auto t = [](const CostRuns& runs) { return static_cast<double>(runs.building.triangles_sorted); };
  const double determinant = n(light) * t(deep) - n(deep) * t(light);
  constants.node = (making(light) * t(deep) - making(deep) * t(light)) / determinant;
  constants.sorted_triangle = (n(light) * making(deep) - n(deep) * making(light)) / determinant;
  if (!(constants.node >= 0)) {  // noise, or no nodes at all
    constants.node = 0;
    constants.sorted_triangle =
        per(making(light) + making(deep), light.building.triangles_sorted + deep.building.triangles_sorted);
  } else if (!(constants.sorted_triangle >= 0)) {
    constants.sorted_triangle = 0;
    constants.node = per(making(light) + making(deep), light.building.nodes_built + deep.building.nodes_built);
  }
  return constants;
}

double predict_seconds(const Statistics& counts, const CostConstants& constants) {
  double sum = 0;
  for (const CostTerm& term : kCostTerms) sum += static_cast<double>(counts.*term.count) * constants.*term.constant;
  return sum;
}

double modelled_seconds(const Statistics& s) {
  return s.broad_seconds + s.hierarchy_seconds + s.partition_seconds + s.narrow_seconds + s.exact_seconds;
}

}  // namespace impinge::schedule
