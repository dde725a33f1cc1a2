// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/pose.hpp"
#include "exact/common_corners.hpp"
#include "exact/triangle_pair.hpp"
#include "impinge/contacts.hpp"
#include "impinge/options.hpp"
#include "scene/scene_view.hpp"

namespace impinge {

/// Two triangles of one object, and the vertices that they have in common.
class SelfPair {
 public:
  SelfPair(const scene::PlacedObject& object, const TrianglePair& pair, Adjacency adjacency) {
    const auto &a = object.mesh->triangles[pair.a], &b = object.mesh->triangles[pair.b];
    if (adjacency == Adjacency::by_index) {
      common_ = exact::common_corners(a, b);
      if (!are_neighbours()) return;
    }
    pose_vertices(object.pose, object.mesh->vertices, a, a_.data());
    pose_vertices(object.pose, object.mesh->vertices, b, b_.data());
    if (adjacency == Adjacency::by_position) common_ = exact::common_corners(a_, b_);
  }

  [[nodiscard]] bool are_neighbours() const { return common_.size > 0; }
  /// How neighbours meet, if they do beyond their common vertices.
  [[nodiscard]] std::optional<Kind> meet_beyond() const {
    return exact::meet_beyond(a_, b_, common_) ? exact::classify(a_, b_) : std::nullopt;
  }

 private:
  Triangle a_, b_;  ///< in the world; by index, of neighbours alone
  exact::CommonCorners common_;
};

}  // namespace impinge
