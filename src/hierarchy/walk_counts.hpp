// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace impinge::hierarchy {

/// Pairs of boxes tested and nodes made: N_v and N_u of the cost function (schedule/cost.hpp).
struct WalkCounts {
  std::uint64_t box_tests = 0;
  std::uint64_t nodes_made = 0;
};

}  // namespace impinge::hierarchy
