// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/leaf_block.hpp"

#include <algorithm>

namespace impinge::paper {
namespace {

/// Two triangles may share an edge; a third one brings an edge of its own, so that an edge's record stays small.
void add_edge(std::vector<LeafEdge>& edges, std::uint16_t u, std::uint16_t v, std::uint16_t triangle) {
  const auto [from, to] = std::minmax(u, v);
  for (LeafEdge& edge : edges) {
    if (edge.from != from || edge.to != to || edge.right != LeafEdge::kNone) continue;
    if (edge.left != triangle) edge.right = triangle;
    return;
  }
  edges.push_back({from, to, triangle, LeafEdge::kNone});
}

}  // namespace

LeafBlock make_leaf_block(const MeshData& mesh, std::span<const std::uint32_t> triangles) {
  LeafBlock block;
  block.triangles.assign(triangles.begin(), triangles.end());
  std::sort(block.triangles.begin(), block.triangles.end());
  for (const std::uint32_t t : block.triangles)
    block.vertices.insert(block.vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  std::sort(block.vertices.begin(), block.vertices.end());
  block.vertices.erase(std::unique(block.vertices.begin(), block.vertices.end()), block.vertices.end());
  block.vertices.shrink_to_fit();

  const auto local = [&](std::uint32_t vertex) {
    const auto found = std::lower_bound(block.vertices.begin(), block.vertices.end(), vertex);
    return static_cast<std::uint16_t>(found - block.vertices.begin());
  };
  block.corners.reserve(triangles.size());
  for (const std::uint32_t t : block.triangles) {
    const auto& v = mesh.triangles[t];
    const std::array<std::uint16_t, 3> c{local(v[0]), local(v[1]), local(v[2])};
    const auto triangle = static_cast<std::uint16_t>(block.corners.size());
    block.corners.push_back(c);
    for (int i = 0; i < 3; ++i) add_edge(block.edges, c[i], c[(i + 1) % 3], triangle);
  }
  block.edges.shrink_to_fit();
  return block;
}

}  // namespace impinge::paper
