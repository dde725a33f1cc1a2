// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/scene_view.hpp"

namespace impinge::scene {

/// Numbers of up to eight meshes at poses, a lane each.
struct alignas(64) PlacedLanes {
  static constexpr std::size_t kMost = 8;
  using Row = double[kMost];

  Row mesh[14];  ///< the MeshBounds, number by number
  // What is found.
  Row world_center[3], world_radius, world_lo[3], world_hi[3];
  std::uint64_t is_valid[kMost], is_clear[kMost];  ///< the pose; whether a glance shows the exact domain
};

/// Up to eight meshes at poses: whether these are valid, and bounds and domain, computed side by side.
class PlacedBlock {
 public:
  static constexpr std::size_t kMost = PlacedLanes::kMost;

  void clear() { size_ = 0; }
  /// The mesh and its pose stay as they are until all is written.
  void add(const MeshData& mesh, const Pose& pose) {
    meshes_[size_] = &mesh, poses_[size_] = &pose;
    ++size_;
    has_lanes_ = false;
  }
  /// Gives member `i` another pose.
  void set_pose(std::size_t i, const Pose& pose) { poses_[i] = &pose; }
  void compute() { run(false); }
  /// Of two members: whether they are apart for certain, by their bounds and within the exact domain, if their poses
  /// are valid. Then there may be nothing to write.
  [[nodiscard]] bool compute_apart();
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool is_valid(std::size_t i) const { return lanes_.is_valid[i] != 0; }
  /// The object, whose pose is valid, but for its group, which it keeps.
  void write(std::size_t i, PlacedObject& object) const;

 private:
  bool run(bool ends_apart);

  std::size_t size_ = 0;
  bool has_lanes_ = false;  ///< of the meshes
  const MeshData* meshes_[kMost];
  const Pose* poses_[kMost];
  PlacedLanes lanes_;
};

}  // namespace impinge::scene
