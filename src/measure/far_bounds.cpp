// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "measure/far_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace impinge::measure {
namespace {

using hierarchy::Frame;
using hierarchy::TreeRef;
using hierarchy::WideLeaf;

void turn(const Frame& frame, const Pose& pose, const Vec3& direction, double* n) {
  const Vec3 v = transpose(to_mat3(pose.R)) * direction;
  for (int i = 0; i < 3; ++i)
    n[i] = double{frame.axes[0][i]} * v.x + double{frame.axes[1][i]} * v.y + double{frame.axes[2][i]} * v.z;
}

void reach_of_children(const TreeRef& ref, const double* n, double scale, double* reach) {
  if (ref.is_leaf()) {
    const float* const half = ref.leaf().half;
    *reach = scale *
             (std::abs(n[0]) * double{half[0]} + std::abs(n[1]) * double{half[1]} + std::abs(n[2]) * double{half[2]});
    return;
  }
  const auto& node = ref.node();
  for (std::uint32_t lane = 0; lane < node.size; ++lane) {
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      sum += n[i] * double{node.center[i][lane]} + std::abs(n[i]) * double{node.half[i][lane]};
    reach[lane] = scale * sum;
  }
}

void reach_of_triangles(const WideLeaf& leaf, const double* n, double scale, double* reach) {
  for (std::uint32_t t = 0; t < leaf.count; ++t) {
    const auto along = [&](int corner) {
      return n[0] * double{leaf.row(3 * corner)[t]} + n[1] * double{leaf.row(3 * corner + 1)[t]} +
             n[2] * double{leaf.row(3 * corner + 2)[t]};
    };
    reach[t] = scale * std::max({along(0), along(1), along(2)});
  }
}

/// Offsets may be beyond the range of a square, which is rare and slow.
double length(const Vec3& v) { return max_component(abs(v)) < 0x1p500 ? norm(v) : std::hypot(v.x, v.y, v.z); }

}  // namespace

Vec3 offset_of(const Frame& a, const Frame& b, const Pose& pose_a, const hierarchy::TreeRelation& relation) {
  double v[3];
  for (int i = 0; i < 3; ++i) {
    v[i] = relation.t[i] - a.origin[i];
    for (int k = 0; k < 3; ++k) v[i] += relation.scaled_columns[k][i] * b.origin[k];
  }
  return to_mat3(pose_a.R) * Vec3{v[0], v[1], v[2]};
}

// A point x of a frame is at F⁻¹ x, and projected to n F⁻¹ x = (F⁻ᵀ n) x. F⁻ᵀ - F is at most 3.01 * 2^-20, so that F n
// in its place is off by 5.3 * 2^-20 of the radius (that is of the largest coordinate, hence sqrt 3). Triangles are
// stored to within 2^-24 of it, and doubles round less than 2^-48. 2^-17 of the radii is taken. The relation's error is
// that of the offset, in which the rounding of world vertices is counted.
std::optional<FarBounds> FarBounds::of(const TreeRef& a, const Pose& pose_a, const TreeRef& b, const Pose& pose_b,
                                       const hierarchy::TreeRelation& relation) {
  constexpr double kFar = 4, kRemote = 128;  // in radii
  const Frame &frame_a = frame_of(a), &frame_b = frame_of(b);
  const Vec3 offset = offset_of(frame_a, frame_b, pose_a, relation);
  const double radii = double{frame_a.radius} + relation.scale * double{frame_b.radius};
  const double distance = length(offset);
  if (!(distance > kFar * radii) || !(distance > 0x1p-400)) return std::nullopt;
  FarBounds bounds;
  bounds.base_ = distance - 0x1p-17 * radii - 2 * relation.error - 0x1p-48 * distance;
  bounds.scale_ = relation.scale;
  bounds.remote_ = distance > kRemote * radii;
  const Vec3 n = (1 / distance) * offset;
  turn(frame_a, pose_a, n, bounds.a_), turn(frame_b, pose_b, -1.0 * n, bounds.b_);
  return bounds;
}

void FarBounds::children(const TreeRef& a, const TreeRef& b, double* reach_a, double* reach_b) const {
  reach_of_children(a, a_, 1, reach_a), reach_of_children(b, b_, scale_, reach_b);
}

void FarBounds::triangles(const WideLeaf& a, const WideLeaf& b, double* reach_a, double* reach_b) const {
  reach_of_triangles(a, a_, 1, reach_a), reach_of_triangles(b, b_, scale_, reach_b);
}

}  // namespace impinge::measure
