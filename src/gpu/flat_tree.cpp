// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/flat_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hierarchy/round_up.hpp"

namespace impinge::gpu {
namespace {

using hierarchy::Frame;
using hierarchy::TreeRef;
using hierarchy::WideLeaf;
using hierarchy::WideNode;

class Flattener {
 public:
  Flattener(hierarchy::WideTree& tree, FlatTree& flat) : tree_(tree), flat_(flat) {}

  /// A node below `level` others, or a leaf, and all that is under it.
  uint add(const TreeRef& ref, std::uint32_t level) {
    flat_.levels = std::max(flat_.levels, level + 1);
    const uint added = ref.is_leaf() ? add_leaf(ref.leaf(), level) : add_node(ref.node(), level);
    flat_.places.emplace_back(ref.address(), added);
    return added;
  }

 private:
  uint add_node(WideNode& node, std::uint32_t level) {
    const auto place = static_cast<uint>(flat_.nodes.size());
    DeviceNode made{};
    made.frame = frame_of(node.frame), made.size = node.size;
    for (std::size_t i = 0; i < 3; ++i) {
      std::copy(node.center[i], node.center[i] + 8, made.center + 8 * i);
      std::copy(node.half[i], node.half[i] + 8, made.extent + 8 * i);
    }
    flat_.nodes.push_back(made);
    hierarchy::MadeNodes nodes_made;
    for (std::uint32_t lane = 0; lane < node.size; ++lane) {
      const uint child = add(tree_.child(node, static_cast<int>(lane), nodes_made), level + 1);
      flat_.nodes[place].child[lane] = child;
    }
    return place;
  }

  uint add_leaf(const WideLeaf& leaf, std::uint32_t level) {
    return add_tiles(leaf, 0, (leaf.count + kTileSize - 1) / kTileSize, level);
  }

  /// A leaf of more triangles than fit in one becomes a node of some, in the same frame.
  uint add_tiles(const WideLeaf& leaf, uint first, uint count, std::uint32_t level) {
    flat_.levels = std::max(flat_.levels, level + 1);
    if (count == 1) return add_tile(leaf, first);
    const auto place = static_cast<uint>(flat_.nodes.size());
    DeviceNode made{};
    made.frame = frame_of(leaf.frame), made.size = std::min(count, kDeviceWidth);
    flat_.nodes.push_back(made);
    for (uint lane = 0; lane < made.size; ++lane) {
      const uint begin = count * lane / made.size, end = count * (lane + 1) / made.size;
      bound_tiles(leaf, first + begin, first + end, lane, flat_.nodes[place]);
      const uint child = add_tiles(leaf, first + begin, end - begin, level + 1);
      flat_.nodes[place].child[lane] = child;
    }
    return place;
  }

  static void bound_tiles(const WideLeaf& leaf, uint first, uint end, uint lane, DeviceNode& node) {
    const std::size_t begin = std::size_t{first} * kTileSize,
                      stop = std::min<std::size_t>(std::size_t{end} * kTileSize, leaf.count);
    for (int i = 0; i < 3; ++i) {
      float least = leaf.row(i)[begin], greatest = least;
      for (int vertex = 0; vertex < 3; ++vertex) {
        const float* const row = leaf.row(3 * vertex + i);
        const auto [low, high] = std::minmax_element(row + begin, row + stop);
        least = std::min(least, *low), greatest = std::max(greatest, *high);
      }
      const float middle = static_cast<float>(0.5 * (double{least} + double{greatest}));
      const double half = std::max(double{greatest} - double{middle}, double{middle} - double{least});
      node.center[8 * i + static_cast<int>(lane)] = middle;
      node.extent[8 * i + static_cast<int>(lane)] = hierarchy::round_up(half + double{leaf.error});
    }
  }

  uint add_tile(const WideLeaf& leaf, uint tile) {
    const auto place = static_cast<uint>(flat_.leaves.size());
    DeviceLeaf made{};
    made.frame = frame_of(leaf.frame);
    std::copy(leaf.half, leaf.half + 3, made.extent);
    made.error = leaf.error, made.inverse_error = leaf.inverse_error;
    made.count = std::min(leaf.count - tile * kTileSize, kTileSize);
    for (int row = 0; row < 9; ++row)
      std::copy_n(leaf.row(row) + std::size_t{tile} * kTileSize, kTileSize, made.rows + std::ptrdiff_t{16} * row);
    std::copy_n(leaf.ids() + std::size_t{tile} * kTileSize, kTileSize, made.ids);
    flat_.leaves.push_back(made);
    return place | kLeafBit;
  }

  /// The origin's two parts leave out less than 2^-48 of it, which the bound on the device counts
  /// (shaders/frames.glsl).
  DeviceFrame frame_of(const Frame& frame) {
    DeviceFrame made{};
    const double base[3] = {flat_.base.x, flat_.base.y, flat_.base.z};
    for (std::size_t l = 0; l < 3; ++l) {
      const double offset = frame.origin[l] - base[l];
      made.origin_hi[l] = static_cast<float>(offset);
      made.origin_lo[l] = static_cast<float>(offset - double{made.origin_hi[l]});
      flat_.reach = std::max(flat_.reach, std::abs(offset));
      std::copy(frame.axes[l], frame.axes[l] + 3, made.axes + 3 * l);
    }
    made.radius = frame.radius;
    return made;
  }

  hierarchy::WideTree& tree_;
  FlatTree& flat_;
};

}  // namespace

FlatTree flatten(hierarchy::WideTree& tree, const ForEach& for_each) {
  tree.build(for_each);
  hierarchy::MadeNodes nodes_made;
  const TreeRef root = tree.root(nodes_made);
  const Frame& frame = root.is_leaf() ? root.leaf().frame : root.node().frame;
  FlatTree flat{.root = 0, .base = {frame.origin[0], frame.origin[1], frame.origin[2]}, .reach = 0, .levels = 0};
  // Room for leaves that are two thirds full: a vector that grows is copied, and a page that is not written to costs
  // nothing.
  const std::size_t triangles =
      root.is_leaf() ? root.leaf().count : std::accumulate(root.node().count, root.node().count + root.node().size, 0u);
  const std::size_t leaves = 3 * triangles / (2 * kTileSize) + 1;
  flat.leaves.reserve(leaves), flat.nodes.reserve(leaves / 2), flat.places.reserve(leaves + leaves / 2);
  flat.root = Flattener(tree, flat).add(root, 0);
  std::sort(flat.places.begin(), flat.places.end());
  return flat;
}

}  // namespace impinge::gpu
