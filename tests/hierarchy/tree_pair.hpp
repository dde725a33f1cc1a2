// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "hierarchy/wide_walk.hpp"
#include "tests/core/support.hpp"

namespace impinge::test {

/// Ids of a triangle of a pair's first tree and of one of its second.
using TriangleIds = std::pair<std::uint32_t, std::uint32_t>;
/// Sorted.
using TrianglePairs = std::vector<TriangleIds>;

/// Fails where a pair comes twice.
inline TrianglePairs sorted_once(TrianglePairs pairs) {
  std::sort(pairs.begin(), pairs.end());
  const auto twice = std::adjacent_find(pairs.begin(), pairs.end());
  EXPECT_EQ(twice, pairs.end()) << twice->first << ' ' << twice->second << " comes twice";
  return pairs;
}

/// Fails with the first that is in `few` and not in `many`.
inline void expect_contains(const TrianglePairs& many, const TrianglePairs& few) {
  if (std::includes(many.begin(), many.end(), few.begin(), few.end())) return;
  for (const auto& pair : few)
    ASSERT_TRUE(std::binary_search(many.begin(), many.end(), pair)) << pair.first << ' ' << pair.second;
}

/// The two objects of a scene with wide trees of their own, that of the larger unit first; those of one mesh share one.
class TreePair {
 public:
  TreePair(const scenes::PlacedScene& scene, std::uint32_t leaf_size)
      : meshes_(meshes_of(scene)),
        trees_{hierarchy::WideTree(numbers(scene, 0), leaf_size), hierarchy::WideTree(numbers(scene, 1), leaf_size)},
        swapped_(trees_[0].unit_exponent() < trees_[1].unit_exponent()),
        first_{meshes_[object(scene, 0).mesh], object(scene, 0).pose, trees_[swapped_ ? 1 : 0]},
        second_{meshes_[object(scene, 1).mesh], object(scene, 1).pose,
                trees_[swapped_ || scene.objects[0].mesh == scene.objects[1].mesh ? 0 : 1]},
        relation_(hierarchy::relate(numbers_of(first_.mesh), first_.pose, first_.tree.unit_exponent(),
                                    numbers_of(second_.mesh), second_.pose, second_.tree.unit_exponent())) {}
  TreePair(const TreePair&) = delete;
  TreePair& operator=(const TreePair&) = delete;

  struct Side {
    Mesh mesh;
    Pose pose;
    hierarchy::WideTree& tree;

    [[nodiscard]] std::vector<Triangle> world() const { return world_triangles(mesh, pose); }
    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(mesh.triangle_count()); }
    /// All leaves, made now.
    [[nodiscard]] std::vector<const hierarchy::WideLeaf*> leaves() const {
      std::vector<const hierarchy::WideLeaf*> found;
      hierarchy::MadeNodes made;
      std::vector<hierarchy::TreeRef> open{tree.root(made)};
      while (!open.empty()) {
        const hierarchy::TreeRef next = open.back();
        open.pop_back();
        if (next.is_leaf()) {
          found.push_back(&next.leaf());
          continue;
        }
        for (std::uint32_t lane = 0; lane < next.node().size; ++lane)
          open.push_back(tree.child(next.node(), static_cast<int>(lane), made));
      }
      return found;
    }
  };

  [[nodiscard]] const Side& first() const { return first_; }
  [[nodiscard]] const Side& second() const { return second_; }
  [[nodiscard]] const hierarchy::TreeRelation& relation() const { return relation_; }
  [[nodiscard]] hierarchy::WideWalk walk() const { return {first_.tree, second_.tree, relation_}; }

  /// Every leaf of the first with every leaf of the second.
  [[nodiscard]] std::vector<hierarchy::WideLeafPair> all_leaf_pairs() const {
    std::vector<hierarchy::WideLeafPair> pairs;
    const auto leaves_a = first_.leaves(), leaves_b = second_.leaves();
    for (const auto* a : leaves_a)
      for (const auto* b : leaves_b) pairs.push_back({a, b});
    return pairs;
  }

  /// By brute force, from what brute force found in the scene.
  [[nodiscard]] TrianglePairs touching(const std::vector<Contact>& contacts) const {
    TrianglePairs pairs;
    for (const Contact& c : contacts) pairs.push_back(swapped_ ? TriangleIds{c[3], c[2]} : TriangleIds{c[2], c[3]});
    return sorted_once(std::move(pairs));
  }

 private:
  const MeshData& numbers(const scenes::PlacedScene& scene, std::size_t i) const {
    return numbers_of(meshes_[scene.objects[i].mesh]);
  }
  [[nodiscard]] const scenes::PlacedObject& object(const scenes::PlacedScene& scene, std::size_t side) const {
    return scene.objects[swapped_ ? 1 - side : side];
  }

  std::vector<Mesh> meshes_;
  hierarchy::WideTree trees_[2];
  bool swapped_;
  Side first_, second_;
  hierarchy::TreeRelation relation_;
};

/// The pairs of triangles in pairs of leaves; fails where one comes twice.
inline TrianglePairs triangles_of(const std::vector<hierarchy::WideLeafPair>& leaf_pairs) {
  TrianglePairs pairs;
  for (const auto& [a, b] : leaf_pairs)
    for (std::uint32_t i = 0; i < a->count; ++i)
      for (std::uint32_t j = 0; j < b->count; ++j) pairs.emplace_back(a->ids()[i], b->ids()[j]);
  return sorted_once(std::move(pairs));
}

}  // namespace impinge::test
