// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/for_each.hpp"
#include "core/shapes.hpp"
#include "motion/features.hpp"

namespace impinge::motion {

/// A box that moves linearly: what is inside at both ends, and moves linearly, is inside throughout.
struct BoxPath {
  Box from, to;
};

/// The vertices of a mesh at both ends of their ways.
struct Vertices {
  std::span<const Vec3> from, to;
};

BoxPath path_of(const Vertices& vertices, const Corners& corners);

/// Whether an axis separates two boxes from the start until `end`. The gap along an axis is then a linear function of
/// time, positive throughout if it is at both ends.
bool stay_apart(const BoxPath& a, const BoxPath& b, double end);

/// A balanced binary tree over the triangles of a moving mesh, in the order in which it is walked: a node's first child
/// follows it, and with a first child of n leaves the second comes 2 n - 1 nodes later.
struct PathTree {
  static constexpr std::size_t kLeafSize = 4;

  std::vector<BoxPath> nodes;
  std::vector<std::uint32_t> triangles;  ///< leaf by leaf

  PathTree(const Vertices& vertices, std::span<const Corners> corners, const ForEach& for_each);

  /// A subtree: leaves [first, first + leaves) below node `node`.
  struct Part {
    std::size_t node, first, leaves;
    [[nodiscard]] Part left() const { return {node + 1, first, leaves / 2}; }
    [[nodiscard]] Part right() const { return {node + 2 * (leaves / 2), first + leaves / 2, leaves - leaves / 2}; }
  };
  [[nodiscard]] Part root() const { return {0, 0, (triangles.size() + kLeafSize - 1) / kLeafSize}; }
  /// Of a leaf.
  [[nodiscard]] std::span<const std::uint32_t> triangles_of(const Part& leaf) const {
    const std::size_t first = leaf.first * kLeafSize;
    return std::span(triangles).subspan(first, std::min(kLeafSize, triangles.size() - first));
  }
};

}  // namespace impinge::motion
