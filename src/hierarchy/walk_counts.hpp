// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace impinge::hierarchy {

/// N_v and N_u of the cost function.
struct WalkCounts {
  std::uint64_t box_tests = 0;
  std::uint64_t nodes_made = 0;
};

}  // namespace impinge::hierarchy
