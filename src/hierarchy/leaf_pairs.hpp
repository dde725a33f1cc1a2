// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy/leaf_block.hpp"

namespace impinge::hierarchy {

/// Two leaves whose boxes may overlap, and the number of their object pair.
struct LeafPair {
  const LeafBlock* a;
  const LeafBlock* b;
  std::uint32_t object_pair;
};

using LeafPairs = std::vector<LeafPair>;

}  // namespace impinge::hierarchy
