// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy/tree_relation.hpp"
#include "hierarchy/wide_tree.hpp"

/// Lower bounds of the distances between boxes of two wide trees, or triangles of two leaves: in single precision, as
/// lengths of the world in A's unit, never above the true distance.
namespace impinge::measure {

struct BoxBounds {
  std::uint64_t bits;     ///< bit 8 i + j: box i of A and j of B may be within the limit; i of B where B is not opened
  bool opens_a, opens_b;  ///< whether the boxes are those of its children, or one box for the whole
  alignas(64) float lower[hierarchy::kWidth][hierarchy::kWidth];
};

/// The bounds of the children of two nodes, `of_both`, or else of the much larger one's alone where there is one. A
/// leaf has none.
void bound_boxes(const hierarchy::TreeRef& a, const hierarchy::TreeRef& b, bool of_both,
                 const hierarchy::TreeRelation& relation, float limit, BoxBounds& bounds);

/// The greatest number of triangles in a leaf (TreeConfig).
inline constexpr int kMostInLeaf = 256;

/// The triangles in places `a` and `b` of two leaves.
struct NearTriangles {
  double lower;
  std::uint16_t a, b;
};

/// Which pairs of two leaves are asked for: all within the limit, or the nearest and perhaps some others.
enum class Wanted : std::uint8_t { all, nearest };

/// Replaces the list by the pairs that may be within the limit, by the triangles' boxes, planes and middles. Bounds
/// below 0 are of triangles that may share a point: the farther below, the likelier.
void bound_triangles(const hierarchy::WideLeaf& a, const hierarchy::WideLeaf& b,
                     const hierarchy::TreeRelation& relation, float limit, Wanted wanted,
                     std::vector<NearTriangles>& near);

}  // namespace impinge::measure
