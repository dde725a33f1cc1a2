// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hierarchy/triangle_soup.hpp"
#include "hierarchy/wide_tree.hpp"

namespace impinge::hierarchy {

/// The shape of a tree that is wholly made, as trees of the same triangles with other vertices take it over: which
/// triangles and vertices are in each part, and how its axes turn with its vertices. Needs neither tree nor mesh.
struct RefitPlan {
  /// Vertices of a part, each once: a range of `vertices`.
  struct Vertices {
    std::uint32_t first, count;
  };
  /// The axes of a part and a few of its vertices, a range of `samples`.
  struct Axes {
    float axes[3][4];  ///< as in Frame
    std::uint32_t first_sample, samples;
  };
  /// Where axis i goes, but for a factor of all three: the sum of coefficient[i] times where the vertices are. The
  /// coefficients of each axis add up to 0.
  struct Sample {
    std::uint32_t place;  ///< in `vertices`
    float coefficient[3];
  };
  struct Node {
    Axes axes;
    std::uint32_t size, depth;
    float split_cost;
    std::uint32_t first[kWidth], count[kWidth];  ///< a child's triangles in `order`
    Vertices vertices[kWidth];                   ///< of a child
    std::uint32_t child[kWidth];                 ///< in `nodes` or `leaves`
    bool is_leaf[kWidth];
  };
  struct Leaf {
    Axes axes;
    std::uint32_t first, count;  ///< its triangles in `order`
    Vertices vertices;
    std::size_t corners;  ///< where its triangles' corners begin in `corners`
  };

  static constexpr std::uint32_t kMostSamples = 8;

  std::vector<Node> nodes;   ///< the root is the first
  std::vector<Leaf> leaves;  ///< or the only leaf
  std::vector<Sample> samples;
  std::vector<std::uint32_t> order;     ///< the ids of all triangles, leaf by leaf
  std::vector<std::uint32_t> vertices;  ///< their ids, part by part
  std::vector<std::uint16_t> corners;  ///< of a leaf's triangles: all first ones, second ones, third ones, as places in
                                       ///< its vertices

  [[nodiscard]] std::span<const std::uint32_t> list(const Vertices& part) const {
    return std::span(vertices).subspan(part.first, part.count);
  }
  [[nodiscard]] std::size_t bytes() const;
};

/// Of a tree that is wholly made, from where its vertices are. `before` is the plan that parts of it were refitted by.
/// None if all parts together list 2^32 vertices or more.
std::shared_ptr<const RefitPlan> make_refit_plan(const TreeRef& root, const SoupSource& source,
                                                 const RefitPlan* before);

}  // namespace impinge::hierarchy
