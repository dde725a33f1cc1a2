// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace impinge::broad {

/// Two objects that may touch, a < b; or a = b, one that is tested against itself.
struct ObjectPair {
  std::uint32_t a, b;
  friend bool operator==(const ObjectPair&, const ObjectPair&) = default;
};

/// Sorted by (a, b).
using ObjectPairs = std::vector<ObjectPair>;

}  // namespace impinge::broad
