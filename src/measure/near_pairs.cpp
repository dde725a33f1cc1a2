// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "measure/nearest.hpp"
#include "measure/pair_walk.hpp"
#include "measure/triangle_distance.hpp"

namespace impinge::measure {

void candidate_pairs(const hierarchy::PlacedTree& a, const hierarchy::PlacedTree& b, double within,
                     const TakePair& take, const std::stop_token& stop) {
  if (a.mesh->triangles.empty() || b.mesh->triangles.empty()) return;
  const PairWalk walk(a, b);
  std::vector<NodePair> open{walk.roots()};
  std::vector<NearTriangles> near;
  while (!open.empty() && !stop.stop_requested()) {
    NodePair next = open.back();
    open.pop_back();
    walk.reach(next);
    if (!next.a.is_leaf() || !next.b.is_leaf()) {
      walk.open(next, within, open);
      continue;
    }
    walk.open_leaves(next, within, Wanted::all, near);
    const std::uint32_t *const ids_a = next.a.leaf().ids(), *const ids_b = next.b.leaf().ids();
    for (const NearTriangles& candidate : near) {
      const TrianglePair pair{ids_a[candidate.a], ids_b[candidate.b]};
      if (!take(walk.is_swapped() ? TrianglePair{pair.b, pair.a} : pair)) return;
    }
  }
}

void near_pairs(const hierarchy::PlacedTree& a, const hierarchy::PlacedTree& b, double within, const TakePair& take,
                const std::stop_token& stop) {
  const auto take_near = [&](const TrianglePair& pair) {
    const Triangle of_a = world_triangle(a, pair.a), of_b = world_triangle(b, pair.b);
    return triangle_distance(of_a, of_b, within).lower > within || take(pair);
  };
  candidate_pairs(a, b, within, take_near, stop);
}

}  // namespace impinge::measure
