// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "partition/partition.hpp"

#include <algorithm>

namespace impinge::partition {
namespace {

/// The mean size of the boxes that meet the region: the paper's best cell.
class MeanSize {
 public:
  void add(const std::vector<Box>& boxes, const Box& region) {
    for (const Box& box : boxes) {
      if (!overlap(box, region)) continue;
      sum_ = sum_ + (box.hi - box.lo);
      ++count_;
    }
  }
  [[nodiscard]] Vec3 mean() const { return 1.0 / std::max(count_, 1) * sum_; }

 private:
  Vec3 sum_{0, 0, 0};
  int count_ = 0;
};

void map(const std::vector<Box>& boxes, const Grid& grid, std::vector<Cells>& cells) {
  cells.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) cells[i] = grid.cells_of(boxes[i]);
}

}  // namespace

void Partitioner::pose(const hierarchy::LeafBlock& leaf, std::uint32_t object_pair, const MeshData& mesh,
                       const Pose& pose, PosedLeaf& posed, Batch& batch) {
  if (posed.leaf == &leaf && posed.object_pair == object_pair) return;
  posed.leaf = &leaf;
  posed.object_pair = object_pair;
  const auto first_vertex = static_cast<std::uint32_t>(batch.vertices.size());
  posed.first_edge = static_cast<std::uint32_t>(batch.edges.size());
  posed.first_triangle = static_cast<std::uint32_t>(batch.triangles.size());
  batch.vertices.resize(batch.vertices.size() + leaf.vertices.size());
  Vec3* const vertices = batch.vertices.data() + first_vertex;
  pose_vertices(pose, mesh.vertices, leaf.vertices, vertices);

  posed.edge_boxes.clear();
  for (const hierarchy::LeafEdge& edge : leaf.edges) {
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

/// False if the leaves' world boxes are apart.
bool Partitioner::map_to_cells(PosedLeaf& a, PosedLeaf& b) const {
  const Box region = intersection(a.box, b.box);
  if (is_empty(region)) return false;
  MeanSize size;
  for (const PosedLeaf* leaf : {&a, &b}) {
    size.add(leaf->edge_boxes, region);
    size.add(leaf->triangle_boxes, region);
  }
  const Grid grid(region, size.mean());
  for (PosedLeaf* leaf : {&a, &b}) {
    map(leaf->edge_boxes, grid, leaf->edge_cells);
    map(leaf->triangle_boxes, grid, leaf->triangle_cells);
  }
  return true;
}

std::uint32_t Partitioner::candidate(std::uint32_t a, std::uint32_t b, Batch& batch) {
  std::uint32_t& slot = candidates_[a * b_.leaf->triangles.size() + b];
  if (slot == ElementTest::kNone) {
    slot = static_cast<std::uint32_t>(batch.pairs.size());
    batch.pairs.push_back(
        {a_.object_pair, a_.leaf->triangles[a], b_.leaf->triangles[b], a_.first_triangle + a, b_.first_triangle + b});
  }
  return slot;
}

/// The edges of one leaf against the triangles of the other. Elements that share a cell still go on only if their boxes
/// meet.
void Partitioner::stream(const PosedLeaf& edges, const PosedLeaf& triangles, bool edges_are_a, Batch& batch) {
  const auto pair_of = [&](std::uint16_t owner, std::uint32_t triangle) {
    if (owner == hierarchy::LeafEdge::kNone) return ElementTest::kNone;
    return edges_are_a ? candidate(owner, triangle, batch) : candidate(triangle, owner, batch);
  };
  for (std::uint32_t t = 0; t < triangles.triangle_boxes.size(); ++t) {
    for (std::uint32_t e = 0; e < edges.edge_boxes.size(); ++e) {
      if (config_.grid) {
        if ((edges.edge_cells[e] & triangles.triangle_cells[t]) == 0) continue;
        if (!overlap(edges.edge_boxes[e], triangles.triangle_boxes[t])) continue;
      }
      const hierarchy::LeafEdge& edge = edges.leaf->edges[e];
      batch.tests.push_back(
          {edges.first_edge + e, triangles.first_triangle + t, pair_of(edge.left, t), pair_of(edge.right, t)});
    }
  }
}

void Partitioner::append(const hierarchy::LeafPair& pair, const PlacedMeshes& placed, Batch& batch) {
  pose(*pair.a, pair.object_pair, placed.mesh_a, placed.pose_a, a_, batch);
  pose(*pair.b, pair.object_pair, placed.mesh_b, placed.pose_b, b_, batch);
  if (config_.grid && !map_to_cells(a_, b_)) return;
  candidates_.assign(pair.a->triangles.size() * pair.b->triangles.size(), ElementTest::kNone);
  stream(a_, b_, true, batch);
  stream(b_, a_, false, batch);
}

}  // namespace impinge::partition
