// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/shapes.hpp"

namespace impinge::broad {

/// Two objects that may touch, a < b, and the box that holds whatever they share.
struct ObjectPair {
  std::uint32_t a, b;
  Box overlap;
};

/// Sorted by (a, b).
using ObjectPairs = std::vector<ObjectPair>;

}  // namespace impinge::broad
