// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "schedule/cost.hpp"

#include <algorithm>

namespace impinge::schedule {

CostConstants constants_from(const Statistics& building, const Statistics& repeated, const Statistics& touching) {
  const auto per = [](double seconds, std::uint64_t count) {
    return std::max(seconds, 0.0) / static_cast<double>(std::max<std::uint64_t>(count, 1));
  };
  return {
      .box_test = per(repeated.hierarchy_seconds, repeated.box_tests),
      .element_test = per(repeated.narrow_seconds, repeated.element_tests),
      .node = per(building.hierarchy_seconds - repeated.hierarchy_seconds, building.nodes_built),
      .leaf_pair = per(repeated.partition_seconds, repeated.leaf_pairs),
      .exact_call = per(touching.exact_seconds, touching.exact_calls),
  };
}

double predict_seconds(const Statistics& counts, const CostConstants& constants) {
  return static_cast<double>(counts.box_tests) * constants.box_test +
         static_cast<double>(counts.element_tests) * constants.element_test +
         static_cast<double>(counts.nodes_built) * constants.node +
         static_cast<double>(counts.leaf_pairs) * constants.leaf_pair +
         static_cast<double>(counts.exact_calls) * constants.exact_call;
}

double modelled_seconds(const Statistics& s) {
  return s.hierarchy_seconds + s.partition_seconds + s.narrow_seconds + s.exact_seconds;
}

}  // namespace impinge::schedule
