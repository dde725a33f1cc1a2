// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/partition.hpp"

#include <algorithm>

namespace impinge::paper {
namespace {

/// Adds up the sizes of the boxes that meet the region and lists them.
template <class Elements>
void select(const std::vector<Box>& boxes, const Box& region, Elements& elements, Vec3& total_size) {
  elements.clear();
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!overlap(boxes[i], region)) continue;
    elements.push_back({i, 0});
    total_size = total_size + (boxes[i].hi - boxes[i].lo);
  }
}

template <class Elements>
void select_all(const std::vector<Box>& boxes, Elements& elements) {
  elements.clear();
  for (std::uint32_t i = 0; i < boxes.size(); ++i) elements.push_back({i, ~partition::Cells{0}});
}

}  // namespace

void Partitioner::pose(const LeafBlock& leaf, const MeshData& mesh, const Pose& pose, PosedLeaf& posed, Batch& batch) {
  if (posed.leaf == &leaf) return;
  posed.leaf = &leaf;
  const auto first_vertex = static_cast<std::uint32_t>(batch.vertices.size());
  posed.first_edge = static_cast<std::uint32_t>(batch.edges.size());
  posed.first_triangle = static_cast<std::uint32_t>(batch.triangles.size());
  batch.vertices.resize(batch.vertices.size() + leaf.vertices.size());
  Vec3* const vertices = batch.vertices.data() + first_vertex;
  pose_vertices(pose, mesh.vertices, leaf.vertices, vertices);

  posed.edge_boxes.clear();
  for (const LeafEdge& edge : leaf.edges) {
    batch.edges.push_back({first_vertex + edge.from, first_vertex + edge.to});
    posed.edge_boxes.push_back(box_of(Segment{vertices[edge.from], vertices[edge.to]}));
  }
  posed.triangle_boxes.clear();
  posed.box = {vertices[0], vertices[0]};
  for (const auto& c : leaf.corners) {
    batch.triangles.push_back({first_vertex + c[0], first_vertex + c[1], first_vertex + c[2]});
    const Box box = box_of(Triangle{vertices[c[0]], vertices[c[1]], vertices[c[2]]});
    posed.triangle_boxes.push_back(box);
    posed.box = {min(posed.box.lo, box.lo), max(posed.box.hi, box.hi)};
  }
}

/// Lays the grid over the overlap of the leaves, a cell as large as the mean box of the elements there (the paper's
/// best), and maps those elements to it.
void Partitioner::map_to_cells(const Box& region) {
  Vec3 total_size{0, 0, 0};
  for (PosedLeaf* leaf : {&a_, &b_}) {
    select(leaf->edge_boxes, region, leaf->edges, total_size);
    select(leaf->triangle_boxes, region, leaf->triangles, total_size);
  }
  const std::size_t count = a_.edges.size() + a_.triangles.size() + b_.edges.size() + b_.triangles.size();
  const partition::Grid grid(region, 1.0 / static_cast<double>(std::max<std::size_t>(count, 1)) * total_size);
  for (PosedLeaf* leaf : {&a_, &b_}) {
    for (Element& edge : leaf->edges) edge.cells = grid.cells_of(leaf->edge_boxes[edge.index]);
    for (Element& triangle : leaf->triangles) triangle.cells = grid.cells_of(leaf->triangle_boxes[triangle.index]);
  }
}

std::uint32_t Partitioner::candidate(std::uint32_t a, std::uint32_t b, Batch& batch) {
  std::uint32_t& slot = candidates_[a * b_.leaf->triangles.size() + b];
  if (slot == ElementTest::kNone) {
    slot = static_cast<std::uint32_t>(batch.pairs.size());
    batch.pairs.push_back({a_.leaf->triangles[a], b_.leaf->triangles[b], a_.first_triangle + a, b_.first_triangle + b});
  }
  return slot;
}

/// The edges of one leaf against the triangles of the other. Elements that share a cell still go on only if their boxes
/// meet.
void Partitioner::stream(const PosedLeaf& edges, const PosedLeaf& triangles, bool edges_are_a, Batch& batch) {
  const auto pair_of = [&](std::uint16_t owner, std::uint32_t triangle) {
    if (owner == LeafEdge::kNone) return ElementTest::kNone;
    return edges_are_a ? candidate(owner, triangle, batch) : candidate(triangle, owner, batch);
  };
  for (const Element& triangle : triangles.triangles) {
    const std::uint32_t t = triangle.index;
    for (const Element& element : edges.edges) {
      if ((element.cells & triangle.cells) == 0) continue;
      const std::uint32_t e = element.index;
      if (partition_ != Partition::all && !overlap(edges.edge_boxes[e], triangles.triangle_boxes[t])) continue;
      const LeafEdge& edge = edges.leaf->edges[e];
      batch.tests.push_back(
          {edges.first_edge + e, triangles.first_triangle + t, pair_of(edge.left, t), pair_of(edge.right, t)});
    }
  }
}

void Partitioner::append(const LeafPair& pair, const PlacedMeshes& placed, Batch& batch) {
  pose(*pair.a, placed.mesh_a, placed.pose_a, a_, batch);
  pose(*pair.b, placed.mesh_b, placed.pose_b, b_, batch);
  const Box region = intersection(a_.box, b_.box);
  if (partition_ != Partition::all && is_empty(region)) return;
  if (partition_ == Partition::grid || partition_ == Partition::automatic) {
    map_to_cells(region);
  } else {
    for (PosedLeaf* leaf : {&a_, &b_}) {
      select_all(leaf->edge_boxes, leaf->edges);
      select_all(leaf->triangle_boxes, leaf->triangles);
    }
  }
  candidates_.assign(pair.a->triangles.size() * pair.b->triangles.size(), ElementTest::kNone);
  stream(a_, b_, true, batch);
  stream(b_, a_, false, batch);
}

}  // namespace impinge::paper
