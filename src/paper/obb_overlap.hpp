// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/mesh_data.hpp"
#include "core/shapes.hpp"
#include "paper/obb.hpp"

namespace impinge::paper {

/// The map from B's frame to A's, x -> M x + t, and how far apart boxes of the two must appear to be apart for certain.
struct RelativePose {
  Mat3 M;
  Vec3 t;
  double margin;

  RelativePose(const Pose& pose_a, const MeshData& mesh_a, const Pose& pose_b, const MeshData& mesh_b);

  /// A box of B in A's frame.
  [[nodiscard]] Obb moved(const Obb& b) const;
};

/// Whether the boxes, both in A's frame, may hold triangles that share a point in the world: the fifteen separating
/// axes of two boxes (Gottschalk, Lin, Manocha 1996). Conservative: false only if they certainly do not.
bool may_overlap(const Obb& a, const Obb& b, double margin);

/// Whether the box, posed, may hold a triangle that reaches `region`. Conservative too.
bool may_reach(const Obb& box, const Pose& pose, const Vec3& rounding, const Box& region);

}  // namespace impinge::paper
