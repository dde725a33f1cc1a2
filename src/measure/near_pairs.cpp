// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "measure/nearest.hpp"
#include "measure/pair_walk.hpp"
#include "measure/triangle_distance.hpp"

namespace impinge::measure {

void near_pairs(const hierarchy::PlacedTree& a, const hierarchy::PlacedTree& b, double within,
                std::vector<TrianglePair>& pairs) {
  if (a.mesh->triangles.empty() || b.mesh->triangles.empty()) return;
  const PairWalk walk(a, b);
  std::vector<NodePair> open{walk.roots()};
  std::vector<NearTriangles> near;
  while (!open.empty()) {
    NodePair next = open.back();
    open.pop_back();
    walk.reach(next);
    if (!next.a.is_leaf() || !next.b.is_leaf()) {
      walk.open(next, within, open);
      continue;
    }
    walk.open_leaves(next, within, near);
    const std::uint32_t *const ids_a = next.a.leaf().ids(), *const ids_b = next.b.leaf().ids();
    for (const NearTriangles& candidate : near) {
      const TrianglePair pair{ids_a[candidate.a], ids_b[candidate.b]};
      const Triangle of_a = world_triangle(walk.a(), pair.a), of_b = world_triangle(walk.b(), pair.b);
      if (triangle_distance(of_a, of_b, within).lower > within) continue;
      pairs.push_back(walk.is_swapped() ? TrianglePair{pair.b, pair.a} : pair);
    }
  }
}

}  // namespace impinge::measure
