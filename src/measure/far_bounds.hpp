// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "hierarchy/placed_tree.hpp"
#include "hierarchy/tree_relation.hpp"
#include "measure/lower_bounds.hpp"

namespace impinge::measure {

/// The vector from A's origin to B's in the world, in A's unit.
Vec3 offset_of(const hierarchy::Frame& a, const hierarchy::Frame& b, const Pose& pose_a,
               const hierarchy::TreeRelation& relation);

/// Lower bounds for two nodes or leaves that are far apart compared with their sizes. There the rounding of single
/// precision, which is relative to the distance, is large compared with the nodes, and gaps between boxes say little.
/// Projections onto the line from one origin to the other have errors relative to the nodes' sizes only.
class FarBounds {
 public:
  /// Nothing for two nodes that are not far apart.
  static std::optional<FarBounds> of(const hierarchy::TreeRef& a, const Pose& pose_a, const hierarchy::TreeRef& b,
                                     const Pose& pose_b, const hierarchy::TreeRelation& relation);

  /// Whether they are so far apart that no other bound is of use.
  [[nodiscard]] bool are_remote() const { return remote_; }

  /// No points of child i of A and child j of B, a leaf being its own only child, are nearer to each other than
  /// base() - a[i] - b[j]; likewise of triangles of two leaves.
  [[nodiscard]] double base() const { return base_; }
  void children(const hierarchy::TreeRef& a, const hierarchy::TreeRef& b, double* reach_a, double* reach_b) const;
  void triangles(const hierarchy::WideLeaf& a, const hierarchy::WideLeaf& b, double* reach_a, double* reach_b) const;

 private:
  double base_ = 0, scale_ = 1;
  double a_[3]{}, b_[3]{};  ///< the direction to the other, in the frames
  bool remote_ = false;
};

}  // namespace impinge::measure
