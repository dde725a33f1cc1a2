// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "gpu/flat_tree.hpp"
#include "gpu/layout.h"
#include "hierarchy/tree_relation.hpp"

namespace impinge::gpu {

/// Where a tree's numbers are counted from, and how far they reach: FlatTree's.
struct TreeExtent {
  Vec3 base;
  double reach;
};

/// The relation of two trees for the device. Nothing if they are so far apart, or so unlike, that its numbers could
/// leave the range that the bounds were made for: the CPU takes such pairs.
std::optional<DeviceRelation> device_relation(const hierarchy::TreeRelation& relation, const TreeExtent& a,
                                              const TreeExtent& b);

}  // namespace impinge::gpu
