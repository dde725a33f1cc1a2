// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "measure/pair_walk.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/pose.hpp"
#include "hierarchy/round_up.hpp"

namespace impinge::measure {
namespace {

using hierarchy::Frame;
using hierarchy::kWidth;
using hierarchy::PlacedTree;
using hierarchy::TreeRef;
using hierarchy::TreeRelation;

const Frame& frame_of(const TreeRef& ref) { return ref.is_leaf() ? ref.leaf().frame : ref.node().frame; }

TreeRef root_of(const PlacedTree& body, const ForEach& for_each) {
  std::uint64_t nodes_made = 0;
  return body.tree->root(nodes_made, for_each);
}

void step_down(const PlacedTree& body, TreeRef& ref, std::int8_t& lane, const ForEach& for_each) {
  std::uint64_t nodes_made = 0;
  if (lane != NodePair::kSelf) ref = body.tree->child(ref.node(), lane, nodes_made, for_each);
  lane = NodePair::kSelf;
}

std::int8_t lane_of(const TreeRef& parent, int lane) {
  return parent.is_leaf() ? NodePair::kSelf : static_cast<std::int8_t>(lane);
}

/// From A's origin to B's in the world, in A's unit.
Vec3 offset_of(const Frame& a, const Frame& b, const PlacedTree& body_a, const TreeRelation& relation) {
  double v[3];
  for (int i = 0; i < 3; ++i) {
    v[i] = relation.t[i] - a.origin[i];
    for (int k = 0; k < 3; ++k) v[i] += relation.scaled_columns[k][i] * b.origin[k];
  }
  return to_mat3(body_a.pose.R) * Vec3{v[0], v[1], v[2]};
}

/// How far each child reaches in a direction of the world from its parent's origin.
struct Reach {
  double of[kWidth];

  Reach(const TreeRef& ref, const Pose& pose, const Vec3& direction) {
    const Frame& frame = frame_of(ref);
    const Vec3 v = transpose(to_mat3(pose.R)) * direction;
    double n[3];
    for (int i = 0; i < 3; ++i)
      n[i] = double{frame.axes[0][i]} * v.x + double{frame.axes[1][i]} * v.y + double{frame.axes[2][i]} * v.z;
    const int size = ref.is_leaf() ? 1 : static_cast<int>(ref.node().size);
    for (int lane = 0; lane < size; ++lane) {
      of[lane] = 0;
      for (int i = 0; i < 3; ++i)
        of[lane] += ref.is_leaf() ? std::abs(n[i]) * double{ref.leaf().half[i]}
                                  : n[i] * double{ref.node().center[i][lane]} +
                                        std::abs(n[i]) * double{ref.node().half[i][lane]};
    }
  }
};

/// Where nodes are far apart beside their size, the rounding of single precision is large beside them, and gaps between
/// boxes tell little. Then the projections onto the line from the one origin to the other do, for their errors are parts
/// of the nodes' sizes and not of the distance: F⁻ᵀ - F is at most 3.01 * 2^-20, so that 5.3 * 2^-20 of the radii (the
/// largest coordinates, hence sqrt 3) is what n F⁻ᵀ x may be off; 2^-17 is taken.
struct FarBounds {
  double base;
  Reach a, b;

  [[nodiscard]] double lower(int i, int j) const { return base - a.of[i] - b.of[j]; }
};

std::optional<FarBounds> far_bounds(const NodePair& pair, const PlacedTree& a, const PlacedTree& b,
                                    const TreeRelation& relation) {
  const Frame &frame_a = frame_of(pair.a), &frame_b = frame_of(pair.b);
  const Vec3 offset = offset_of(frame_a, frame_b, a, relation);
  const double radii = double{frame_a.radius} + relation.scale * double{frame_b.radius};
  const double distance = std::hypot(offset.x, offset.y, offset.z);  // offsets may be beyond the square root's range
  if (!(distance > 4 * radii)) return std::nullopt;
  const Vec3 n = (1 / distance) * offset;
  FarBounds bounds{distance - 0x1p-17 * radii - 2 * relation.error - 0x1p-48 * distance, {pair.a, a.pose, n},
                   {pair.b, b.pose, -1.0 * n}};
  for (double& reach : bounds.b.of) reach *= relation.scale;
  return bounds;
}

}  // namespace

Triangle world_triangle(const PlacedTree& body, std::uint32_t triangle) {
  Triangle world;
  pose_vertices(body.pose, body.mesh->vertices, body.mesh->triangles[triangle], world.data());
  return world;
}

PairWalk::PairWalk(const PlacedTree& a, const PlacedTree& b, const ForEach& for_each)
    : swapped_(a.tree->unit_exponent() < b.tree->unit_exponent()),
      a_(swapped_ ? b : a),
      b_(swapped_ ? a : b),
      unit_(std::ldexp(1.0, a_.tree->unit_exponent())),
      relation_(hierarchy::relate(*a_.mesh, a_.pose, a_.tree->unit_exponent(), *b_.mesh, b_.pose,
                                  b_.tree->unit_exponent())),
      for_each_(for_each) {}

NodePair PairWalk::roots() const {
  return {0, root_of(a_, for_each_), root_of(b_, for_each_), NodePair::kSelf, NodePair::kSelf, 0};
}

void PairWalk::reach(NodePair& pair) const {
  step_down(a_, pair.a, pair.lane_a, for_each_), step_down(b_, pair.b, pair.lane_b, for_each_);
}

bool PairWalk::are_remote() const {
  const NodePair pair = roots();
  const Frame &a = frame_of(pair.a), &b = frame_of(pair.b);
  const Vec3 offset = offset_of(a, b, a_, relation_);
  return max_component(abs(offset)) > 256 * (double{a.radius} + relation_.scale * double{b.radius});
}

float PairWalk::in_unit(double limit) const { return hierarchy::round_up(limit / unit_); }

void PairWalk::open(const NodePair& pair, double limit, std::vector<NodePair>& children) const {
  BoxBounds bounds;
  bound_boxes(pair.a, pair.b, relation_, in_unit(limit), bounds);
  if (bounds.bits == 0) return;
  const auto far = far_bounds(pair, a_, b_, relation_);
  for (std::uint64_t bits = bounds.bits; bits != 0; bits &= bits - 1) {
    const int bit = std::countr_zero(bits), one = bit / kWidth, lane = bit % kWidth;
    const int i = bounds.b_is_one ? lane : one, j = bounds.b_is_one ? one : lane;
    double lower = world_length(bounds.lower[one][lane]);
    if (far) lower = std::max(lower, unit_ * far->lower(i, j));
    if (lower > limit) continue;
    children.push_back({lower, pair.a, pair.b, lane_of(pair.a, i), lane_of(pair.b, j),
                        static_cast<std::uint16_t>(pair.depth + 1)});
  }
}

void PairWalk::open_leaves(const NodePair& pair, double limit, std::vector<NearTriangles>& near) const {
  bound_triangles(pair.a.leaf(), pair.b.leaf(), relation_, in_unit(limit), near);
}

}  // namespace impinge::measure
