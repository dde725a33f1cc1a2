// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/obb_tree.hpp"

#include <algorithm>
#include <numeric>

namespace impinge::paper {
namespace {

/// Below this depth nodes are halved by count, so the depth is at most this and log2 of the triangles, even where each
/// split at the mean peels off one triangle.
constexpr std::uint32_t kDeepestMeanSplit = 40;

Vec3 triple_centroid(const MeshData& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]];
}

}  // namespace

std::size_t ObbTree::bytes() const {
  std::size_t bytes = nodes_.capacity() * sizeof(Node) + blocks_.capacity() * sizeof(LeafBlock);
  for (const LeafBlock& block : blocks_) {
    bytes += block.triangles.capacity() * sizeof(block.triangles[0]);
    bytes += block.vertices.capacity() * sizeof(block.vertices[0]);
    bytes += block.corners.capacity() * sizeof(block.corners[0]) + block.edges.capacity() * sizeof(block.edges[0]);
  }
  return bytes + order_.capacity() * sizeof(order_[0]);
}

void ObbTree::prepare(hierarchy::MadeNodes& made) {
  std::call_once(root_made_, [&] {
    order_.resize(mesh_.triangles.size());
    std::iota(order_.begin(), order_.end(), 0u);
    const Draft root = draft(0, static_cast<std::uint32_t>(order_.size()), 0);
    publish(root, *nodes_.grow_by(1));
    ++made.nodes, made.triangles += order_.size();
  });
}

ObbTree::Draft ObbTree::draft(std::uint32_t first, std::uint32_t count, std::uint32_t depth) {
  const std::span<const std::uint32_t> triangles = std::span(order_).subspan(first, count);
  Draft draft{fit_obb(mesh_, triangles), first, count, depth, 0};
  if (count > leaf_size_) return draft;
  const auto block = blocks_.push_back(make_leaf_block(mesh_, triangles));
  draft.leaf = static_cast<std::uint32_t>(block - blocks_.begin());
  return draft;
}

void ObbTree::publish(const Draft& draft, Node& node) const {
  node.box = draft.box;
  node.first = draft.first;
  node.count = draft.count;
  node.depth = draft.depth;
  node.leaf = draft.leaf;
  if (draft.count <= leaf_size_) node.children.store(kLeaf, std::memory_order_release);
}

std::uint32_t ObbTree::children(std::uint32_t index, hierarchy::MadeNodes& made) {
  Node& node = nodes_[index];
  const auto settle = [&](std::uint32_t state) {
    node.children.store(state);
    node.children.notify_all();
  };
  std::uint32_t children = node.children.load(std::memory_order_acquire);
  while (children == kUnsplit || children == kBusy) {
    if (children == kBusy) {  // another walk is splitting it
      node.children.wait(kBusy, std::memory_order_acquire);
      children = node.children.load(std::memory_order_acquire);
    } else if (node.children.compare_exchange_weak(children, kBusy, std::memory_order_acquire)) {
      try {
        children = split(node);
      } catch (...) {  // out of memory: whoever waits, or comes later, may try again
        settle(kUnsplit);
        throw;
      }
      made.nodes += 2, made.triangles += node.count;
      settle(children);
    }
  }
  return children;
}

std::uint32_t ObbTree::split(const Node& node) {
  const std::uint32_t left_count = partition(node);
  const Draft left = draft(node.first, left_count, node.depth + 1);
  const Draft right = draft(node.first + left_count, node.count - left_count, node.depth + 1);
  const auto pair = nodes_.grow_by(2);
  publish(left, pair[0]);
  publish(right, pair[1]);
  return static_cast<std::uint32_t>(pair - nodes_.begin());
}

/// Orders a node's triangles by a plane across its longest axis, through the mean of their centroids if that parts
/// them, else by count, and returns how many come first. Any order makes a true tree, so rounding is harmless here.
std::uint32_t ObbTree::partition(const Node& node) {
  const auto begin = order_.begin() + node.first, end = begin + node.count;
  const Vec3& half = node.box.half;
  const int longest = half.x >= half.y ? (half.x >= half.z ? 0 : 2) : (half.y >= half.z ? 1 : 2);
  const Vec3 axis = node.box.axes[longest];
  const Vec3 origin = 3.0 * node.box.center;
  const auto position = [&](std::uint32_t triangle) { return dot(axis, triple_centroid(mesh_, triangle) - origin); };

  if (node.depth < kDeepestMeanSplit) {
    double mean = 0;
    for (auto i = begin; i != end; ++i) mean += position(*i);
    mean /= node.count;
    const auto middle = std::partition(begin, end, [&](std::uint32_t t) { return position(t) < mean; });
    if (middle != begin && middle != end) return static_cast<std::uint32_t>(middle - begin);
  }
  const auto middle = begin + node.count / 2;
  std::nth_element(begin, middle, end, [&](std::uint32_t s, std::uint32_t t) {
    const double ps = position(s), pt = position(t);
    return ps < pt || (ps == pt && s < t);
  });
  return node.count / 2;
}

}  // namespace impinge::paper
