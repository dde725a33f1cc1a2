// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "measure/pair_walk.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/pose.hpp"
#include "hierarchy/round_up.hpp"
#include "measure/far_bounds.hpp"

namespace impinge::measure {
namespace {

using hierarchy::Frame;
using hierarchy::kWidth;
using hierarchy::PlacedTree;
using hierarchy::TreeRef;
using hierarchy::WideLeaf;

TreeRef root_of(const PlacedTree& body, const ForEach& for_each) {
  hierarchy::MadeNodes nodes_made;
  return body.tree->root(nodes_made, for_each);
}

void step_down(const PlacedTree& body, TreeRef& ref, std::int8_t& lane, const ForEach& for_each) {
  hierarchy::MadeNodes nodes_made;
  if (lane != NodePair::kSelf) ref = body.tree->child(ref.node(), lane, nodes_made, for_each);
  lane = NodePair::kSelf;
}

int size_of(const TreeRef& ref) { return ref.is_leaf() ? 1 : static_cast<int>(ref.node().size); }

std::int8_t lane_of(bool is_open, int lane) { return is_open ? static_cast<std::int8_t>(lane) : NodePair::kSelf; }

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
      relation_(
          hierarchy::relate(*a_.mesh, a_.pose, a_.tree->unit_exponent(), *b_.mesh, b_.pose, b_.tree->unit_exponent())),
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
  const Vec3 offset = offset_of(a, b, a_.pose, relation_);
  return max_component(abs(offset)) > 256 * (double{a.radius} + relation_.scale * double{b.radius});
}

float PairWalk::in_unit(double limit) const { return hierarchy::round_up(limit / unit_); }

void PairWalk::open(const NodePair& pair, double limit, std::vector<NodePair>& children) const {
  BoxBounds bounds;
  bounds.opens_a = !pair.a.is_leaf(), bounds.opens_b = !pair.b.is_leaf();
  const auto offer = [&](int i, int j, double lower) {
    if (world_length(lower) > limit) return;
    children.push_back({world_length(lower), pair.a, pair.b, lane_of(bounds.opens_a, i), lane_of(bounds.opens_b, j),
                        static_cast<std::uint16_t>(pair.depth + 1)});
  };
  const auto far = FarBounds::of(pair.a, a_.pose, pair.b, b_.pose, relation_);
  double reach_a[kWidth], reach_b[kWidth];
  if (far) far->children(pair.a, pair.b, reach_a, reach_b);
  if (far && far->are_remote()) {
    for (int i = 0; i < size_of(pair.a); ++i)
      for (int j = 0; j < size_of(pair.b); ++j) offer(i, j, far->base() - reach_a[i] - reach_b[j]);
    return;
  }
  bound_boxes(pair.a, pair.b, far.has_value(), relation_, in_unit(limit), bounds);
  for (std::uint64_t bits = bounds.bits; bits != 0; bits &= bits - 1) {
    const int bit = std::countr_zero(bits), one = bit / kWidth, lane = bit % kWidth;
    const int i = bounds.opens_b ? one : lane, j = bounds.opens_b ? lane : one;
    const double lower = bounds.lower[one][lane];
    offer(i, j, far ? std::max(lower, far->base() - reach_a[i] - reach_b[j]) : lower);
  }
}

void PairWalk::open_leaves(const NodePair& pair, double limit, Wanted wanted, std::vector<NearTriangles>& near) const {
  const WideLeaf &a = pair.a.leaf(), &b = pair.b.leaf();
  const auto far = FarBounds::of(pair.a, a_.pose, pair.b, b_.pose, relation_);
  if (!far) return bound_triangles(a, b, relation_, in_unit(limit), wanted, near);
  double reach_a[kMostInLeaf], reach_b[kMostInLeaf];
  far->triangles(a, b, reach_a, reach_b);
  const auto lower = [&](std::uint32_t i, std::uint32_t j) { return far->base() - reach_a[i] - reach_b[j]; };
  const double most = limit / unit_;
  if (!far->are_remote()) {
    bound_triangles(a, b, relation_, in_unit(limit), wanted, near);
    for (NearTriangles& pair_of : near) pair_of.lower = std::max(pair_of.lower, lower(pair_of.a, pair_of.b));
    std::erase_if(near, [&](const NearTriangles& pair_of) { return pair_of.lower > most; });
    return;
  }
  near.clear();
  for (std::uint32_t i = 0; i < a.count; ++i)
    for (std::uint32_t j = 0; j < b.count; ++j)
      if (lower(i, j) <= most)
        near.push_back({lower(i, j), static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)});
}

}  // namespace impinge::measure
