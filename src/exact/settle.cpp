// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/settle.hpp"

#include <hwy/cache_control.h>

#include <algorithm>

#include "core/pose.hpp"
#include "exact/integers.hpp"
#include "exact/pair_block.hpp"
#include "exact/triangle_pair.hpp"

namespace impinge::exact {
namespace {

/// Hides the latency of memory: vertices are prefetched while a block is filled, and read when it is placed a block
/// later.
void fill(PairBlock& block, std::size_t lane, const MeshData& mesh, std::uint32_t triangle, std::size_t row) {
  for (const std::uint32_t vertex : mesh.triangles[triangle]) {
    block.offsets[row++][lane] = 3 * std::int64_t{vertex};
    hwy::Prefetch(&mesh.vertices[vertex]);
  }
}

template <class Point, class Number>
std::array<Point, 6> points_of(const Number (&rows)[18][PairBlock::kLanes], std::size_t lane) {
  std::array<Point, 6> points;
  for (std::size_t i = 0; i < 6; ++i) points[i] = {rows[3 * i][lane], rows[3 * i + 1][lane], rows[3 * i + 2][lane]};
  return points;
}

Outcome finish(const PairBlock& block, std::size_t lane) {
  const PairSigns signs = block.signs[lane];
  const Outcome outcome = signs.get(PairSigns::kFits, 1) != 0 ? decide(signs, points_of<IntVec>(block.integers, lane))
                                                              : decide(signs, points_of<Vec3>(block.rows, lane));
  return outcome == Outcome::open ? decide_degenerate(points_of<Vec3>(block.rows, lane)) : outcome;
}

}  // namespace

void settle(const MeshData& mesh_a, const Pose& pose_a, const MeshData& mesh_b, const Pose& pose_b,
            std::span<const TrianglePair> pairs, std::vector<Contact>& contacts) {
  constexpr std::size_t kLanes = PairBlock::kLanes;
  std::array<PairBlock, 2> blocks;
  const auto fill_from = [&](std::size_t first, PairBlock& block) {
    for (std::size_t i = first; i < first + kLanes; ++i) {
      const TrianglePair &pair = pairs[std::min(i, pairs.size() - 1)],
                         &later = pairs[std::min(i + kLanes, pairs.size() - 1)];
      hwy::Prefetch(&mesh_a.triangles[later.a]), hwy::Prefetch(&mesh_b.triangles[later.b]);
      fill(block, i - first, mesh_a, pair.a, 0);
      fill(block, i - first, mesh_b, pair.b, 3);
    }
  };
  if (!pairs.empty()) fill_from(0, blocks[0]);
  for (std::size_t first = 0; first < pairs.size(); first += kLanes) {
    PairBlock &block = blocks[first / kLanes % 2], &next = blocks[(first / kLanes + 1) % 2];
    if (first + kLanes < pairs.size()) fill_from(first + kLanes, next);
    place(block, mesh_a.vertices.data(), pose_a, mesh_b.vertices.data(), pose_b);
    compute_signs(block);
    for (std::size_t i = first; i < std::min(first + kLanes, pairs.size()); ++i) {
      Outcome outcome = outcome_of(block.signs[i - first]);
      if (outcome == Outcome::open) outcome = finish(block, i - first);
      if (outcome != Outcome::apart) contacts.push_back({pairs[i].a, pairs[i].b, *kind_of(outcome)});
    }
  }
}

void settle_one_by_one(const MeshData& mesh_a, const Pose& pose_a, const MeshData& mesh_b, const Pose& pose_b,
                       std::span<const TrianglePair> pairs, std::vector<Contact>& contacts) {
  for (const TrianglePair& pair : pairs) {
    Triangle a, b;
    pose_vertices(pose_a, mesh_a.vertices, mesh_a.triangles[pair.a], a.data());
    pose_vertices(pose_b, mesh_b.vertices, mesh_b.triangles[pair.b], b.data());
    if (const auto kind = classify(a, b)) contacts.push_back({pair.a, pair.b, *kind});
  }
}

}  // namespace impinge::exact
