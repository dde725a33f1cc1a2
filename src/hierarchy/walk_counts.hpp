// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace impinge::hierarchy {

/// Nodes of a tree, and the triangles that were sorted into them: N_u and N_t of the cost function (schedule/cost.hpp).
struct MadeNodes {
  std::uint64_t nodes = 0;
  std::uint64_t triangles = 0;
};

/// What a walk did; N_v is the number of its box tests.
struct WalkCounts {
  std::uint64_t box_tests = 0;
  MadeNodes made;
};

}  // namespace impinge::hierarchy
