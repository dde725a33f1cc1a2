// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "motion/features.hpp"
#include "motion/path_tree.hpp"

namespace impinge::motion {

/// The features of eight triangles with their boxes: all faces, and of vertices and edges those in their care.
struct LeafFeatures {
  static constexpr int kMost = 3 * kWidth, kRoom = 32;
  template <int kCount, std::size_t kCorners>
  struct Group {
    static constexpr std::size_t kVertices = kCorners;
    PathBoxes<kCount> boxes;
    alignas(64) std::uint32_t vertices[kVertices][kCount];
    std::uint32_t index[kCount];
    int count;
  };
  Group<kWidth, 3> faces;
  Group<kRoom, 2> edges;
  Group<kRoom, 1> vertices;
  std::uint32_t edges_of[kWidth], vertices_of[kWidth];  ///< bits of what is in the care of each face
  PathBoxes<1> box;                                     ///< of all

  void read(const PathTree& tree, const Features& features, std::size_t leaf);
};

/// Pairs of features by their indices, for each kind a list; a vertex stands before a face.
struct FeaturePairs {
  static constexpr std::size_t kRoom = 1024;
  /// That two leaves may add.
  static constexpr std::size_t kMost = std::size_t{LeafFeatures::kMost} * LeafFeatures::kMost;
  struct List {
    std::array<std::uint32_t, 2> pairs[kRoom];
    std::size_t count = 0;
  };
  List lists[3];  ///< by `Feature`
};

/// How near to each other boxes have to come, in their frame, and until which part of the time, 1 for all.
struct Nearness {
  float until, distance;
};

/// Bit 8 i + j: whether box i of one node and box j of the other may come that near.
std::uint64_t may_meet(const PathTree::Node& a, const PathTree::Node& b, const Nearness& nearness);

/// Whose leaves they are.
enum class Leaves : std::uint8_t { of_two_meshes, of_one_mesh, the_same };

/// Adds the pairs of features whose boxes may come that near. Of one mesh, pairs with a common vertex are left out, and
/// a face and a vertex count as a vertex and a face.
void add_pairs(const LeafFeatures& a, const LeafFeatures& b, Leaves leaves, const Nearness& nearness,
               FeaturePairs& pairs);

}  // namespace impinge::motion
