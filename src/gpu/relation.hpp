// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/mesh_data.hpp"
#include "core/pose.hpp"
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

/// Both meshes in a world of at most 1, in which a device with doubles has every vertex within 2^-49 of contract 1.1's
/// number. `is_usable` is 0 where the world is too small or too large to be scaled so. Where the meshes' numbers begin
/// is left open.
DevicePoses device_poses(const Pose& pose_a, const MeshData& a, const Pose& pose_b, const MeshData& b);

}  // namespace impinge::gpu
