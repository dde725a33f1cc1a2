// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/partition.hpp"

#include <algorithm>
#include <bit>

namespace impinge::paper {
namespace {

/// Visits the numbers of the bits that are set.
template <class Visit>
void for_each_bit(std::uint64_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

}  // namespace

void Partitioner::restart() {
  posed_a_ = {}, posed_b_ = {};
  edge_boxes_.clear(), triangle_boxes_.clear();
}

const Partitioner::PosedLeaf& Partitioner::posed(PosedLeaves& leaves, const LeafBlock& leaf, const MeshData& mesh,
                                                 const Pose& pose, Batch& batch) {
  PosedLeaf& posed = leaves[reinterpret_cast<std::uintptr_t>(&leaf) / sizeof(LeafBlock) % leaves.size()];
  if (posed.leaf == &leaf) return posed;
  posed = {&leaf, static_cast<std::uint32_t>(batch.edges.size()), static_cast<std::uint32_t>(batch.triangles.size())};
  batch.leaves.push_back(posed.first_edge);
  const auto first_vertex = static_cast<std::uint32_t>(batch.vertices.size());
  batch.vertices.resize(batch.vertices.size() + leaf.vertices.size());
  Vec3* const vertices = batch.vertices.data() + first_vertex;
  pose_vertices(pose, mesh.vertices, leaf.vertices, vertices);

  for (const LeafEdge& edge : leaf.edges) {
    batch.edges.push_back({first_vertex + edge.from, first_vertex + edge.to});
    edge_boxes_.push_back(box_of(Segment{vertices[edge.from], vertices[edge.to]}));
  }
  posed.box = {vertices[0], vertices[0]};
  for (const auto& c : leaf.corners) {
    batch.triangles.push_back({first_vertex + c[0], first_vertex + c[1], first_vertex + c[2]});
    const Box box = box_of(Triangle{vertices[c[0]], vertices[c[1]], vertices[c[2]]});
    triangle_boxes_.push_back(box);
    posed.box = {min(posed.box.lo, box.lo), max(posed.box.hi, box.hi)};
  }
  return posed;
}

/// Lays the grid over the overlap of the leaves, a cell as large as the mean box of the elements there (the paper's
/// best), and lists in which cells each of those elements is.
void Partitioner::sort_into_cells(const PosedLeaf& a, const PosedLeaf& b) {
  const Box region = intersection(a.box, b.box);
  Vec3 total_size{0, 0, 0};
  std::size_t count = 0;
  const auto select = [&](const Box* boxes, std::size_t size, std::vector<Element>& elements) {
    elements.clear();
    for (std::uint32_t i = 0; i < size; ++i) {
      if (!overlap(boxes[i], region)) continue;
      elements.push_back({i, 0});
      total_size = total_size + (boxes[i].hi - boxes[i].lo);
      ++count;
    }
  };
  const auto select_of = [&](const PosedLeaf& leaf, Elements& elements) {
    select(edge_boxes_.data() + leaf.first_edge, leaf.leaf->edges.size(), elements.edges);
    select(triangle_boxes_.data() + leaf.first_triangle, leaf.leaf->triangles.size(), elements.triangles);
  };
  select_of(a, in_a_), select_of(b, in_b_);
  const partition::Grid grid(region, 1.0 / static_cast<double>(std::max<std::size_t>(count, 1)) * total_size);
  const auto map = [&](const PosedLeaf& leaf, Elements& elements) {
    for (Element& edge : elements.edges) edge.cells = grid.cells_of(edge_boxes_[leaf.first_edge + edge.index]);
    for (Element& triangle : elements.triangles)
      triangle.cells = grid.cells_of(triangle_boxes_[leaf.first_triangle + triangle.index]);
  };
  map(a, in_a_), map(b, in_b_);
}

std::uint32_t Partitioner::candidate(const PosedLeaf& a, std::uint32_t ta, const PosedLeaf& b, std::uint32_t tb,
                                     Batch& batch) {
  std::uint32_t& slot = candidates_[ta * b.leaf->triangles.size() + tb];
  if (slot == ElementTest::kNone) {
    slot = static_cast<std::uint32_t>(batch.pairs.size());
    batch.pairs.push_back({a.leaf->triangles[ta], b.leaf->triangles[tb], a.first_triangle + ta, b.first_triangle + tb});
  }
  return slot;
}

/// The edges of one leaf against the triangles of the other: those that share a cell, if their boxes meet.
void Partitioner::stream(bool edges_are_a, const PosedLeaf& a, const PosedLeaf& b, Batch& batch) {
  const std::vector<Element>& edges = (edges_are_a ? in_a_ : in_b_).edges;
  const std::vector<Element>& triangles = (edges_are_a ? in_b_ : in_a_).triangles;
  if (edges.empty() || triangles.empty()) return;
  const PosedLeaf &of_edges = edges_are_a ? a : b, &of_triangles = edges_are_a ? b : a;
  const auto pair_of = [&](std::uint16_t owner, std::uint32_t triangle) {
    if (owner == LeafEdge::kNone) return ElementTest::kNone;
    return edges_are_a ? candidate(a, owner, b, triangle, batch) : candidate(a, triangle, b, owner, batch);
  };
  // Of 64 edges at a time, since their set is one number then.
  for (std::size_t first = 0; first < edges.size(); first += 64) {
    const std::size_t count = std::min<std::size_t>(edges.size() - first, 64);
    edges_of_cells_.fill(0);
    for (std::size_t i = 0; i < count; ++i)
      for_each_bit(edges[first + i].cells, [&](std::uint32_t cell) { edges_of_cells_[cell] |= std::uint64_t{1} << i; });
    for (const Element& triangle : triangles) {
      const std::uint32_t t = of_triangles.first_triangle + triangle.index;
      std::uint64_t near = 0;
      for_each_bit(triangle.cells, [&](std::uint32_t cell) { near |= edges_of_cells_[cell]; });
      shared_cells_ += static_cast<std::uint64_t>(std::popcount(near));
      for_each_bit(near, [&](std::uint32_t i) {
        const std::uint32_t e = edges[first + i].index;
        if (!overlap(edge_boxes_[of_edges.first_edge + e], triangle_boxes_[t])) return;
        const LeafEdge& edge = of_edges.leaf->edges[e];
        batch.tests.push_back(
            {of_edges.first_edge + e, t, pair_of(edge.left, triangle.index), pair_of(edge.right, triangle.index)});
      });
    }
  }
}

void Partitioner::append(const LeafPair& pair, const PlacedMeshes& placed, Batch& batch) {
  const PosedLeaf& a = posed(posed_a_, *pair.a, placed.mesh_a, placed.pose_a, batch);
  const PosedLeaf& b = posed(posed_b_, *pair.b, placed.mesh_b, placed.pose_b, batch);
  if (!overlap(a.box, b.box)) return;
  sort_into_cells(a, b);
  candidates_.assign(pair.a->triangles.size() * pair.b->triangles.size(), ElementTest::kNone);
  stream(true, a, b, batch);
  stream(false, a, b, batch);
}

}  // namespace impinge::paper
