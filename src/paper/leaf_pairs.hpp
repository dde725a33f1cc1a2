// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "paper/leaf_block.hpp"

namespace impinge::hierarchy {

/// Two leaves whose boxes may overlap.
struct LeafPair {
  const LeafBlock* a;
  const LeafBlock* b;
};

using LeafPairs = std::vector<LeafPair>;

}  // namespace impinge::hierarchy
