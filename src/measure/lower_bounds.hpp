// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy/tree_relation.hpp"
#include "hierarchy/wide_tree.hpp"

/// How near boxes of two wide trees, or triangles of two leaves, may be to each other: in single precision, in A's unit
/// and in lengths of the world, never above the true distance.
namespace impinge::measure {

struct BoxBounds {
  std::uint64_t bits;  ///< bit 8 i + j: box i of the one side and j of the other may be within the limit
  bool b_is_one;       ///< B is the one side: a leaf, whose only box is held against the other's eight
  alignas(64) float lower[hierarchy::kWidth][hierarchy::kWidth];
};

/// Of the children of two nodes, a leaf being its own only child.
void bound_boxes(const hierarchy::TreeRef& a, const hierarchy::TreeRef& b, const hierarchy::TreeRelation& relation,
                 float limit, BoxBounds& bounds);

/// Of triangles (TreeConfig).
inline constexpr int kMostInLeaf = 256;

/// The triangles in places `a` and `b` of two leaves.
struct NearTriangles {
  double lower;
  std::uint16_t a, b;
};

/// Replaces the list by the pairs that may be within the limit, by the triangles' boxes.
void bound_triangles(const hierarchy::WideLeaf& a, const hierarchy::WideLeaf& b,
                     const hierarchy::TreeRelation& relation, float limit, std::vector<NearTriangles>& near);

}  // namespace impinge::measure
