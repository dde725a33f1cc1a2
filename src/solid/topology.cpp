// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/topology.hpp"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "core/hash.hpp"
#include "exact/segment.hpp"

namespace impinge::solid {
namespace {

/// Numbers positions in the order in which they are first seen: an open hash table of vertices, a vertex a position.
void number_positions(const std::vector<Vec3>& world, Topology& topology) {
  constexpr std::uint32_t kFree = 0xffffffff;
  const std::size_t slots = std::bit_ceil(2 * world.size() + 1);
  std::vector<std::uint32_t> table(slots, kFree);
  topology.position.resize(world.size());
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Vec3& v = world[i];
    std::size_t slot = mix(mix(number_bits(v.x), number_bits(v.y)), number_bits(v.z)) & (slots - 1);
    while (table[slot] != kFree && !(world[table[slot]] == v)) slot = (slot + 1) & (slots - 1);
    const bool is_new = table[slot] == kFree;
    if (is_new) table[slot] = static_cast<std::uint32_t>(i);
    topology.position[i] = is_new ? topology.positions++ : topology.position[table[slot]];
  }
}

/// A triangle's use of an edge, kept with the edge's lower position.
struct Use {
  std::uint32_t other;     ///< the higher position
  std::uint32_t triangle;  ///< kNoShell of a degenerate one
  int way;                 ///< +1 from the lower to the higher, -1 back
};

/// What runs along each edge, by the edge's lower position in compressed rows, each row sorted by the higher one. Edges
/// whose ends are one position are left out.
struct Uses {
  std::vector<std::size_t> offsets;
  std::vector<Use> uses;
};

Uses uses_of(const MeshData& mesh, const Topology& topology) {
  const auto each = [&](const auto& take) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = topology.position[mesh.triangles[t][i]];
        const std::uint32_t to = topology.position[mesh.triangles[t][(i + 1) % 3]];
        if (from != to) take(static_cast<std::uint32_t>(t), from, to);
      }
    }
  };
  Uses rows;
  rows.offsets.assign(topology.positions + 1, 0);
  each([&](std::uint32_t, std::uint32_t from, std::uint32_t to) { ++rows.offsets[std::min(from, to) + 1]; });
  for (std::size_t i = 1; i < rows.offsets.size(); ++i) rows.offsets[i] += rows.offsets[i - 1];
  rows.uses.resize(rows.offsets.back());
  std::vector<std::size_t> next = rows.offsets;
  each([&](std::uint32_t t, std::uint32_t from, std::uint32_t to) {
    const bool proper = topology.shell[t] != Topology::kNoShell;
    rows.uses[next[std::min(from, to)]++] = {std::max(from, to), proper ? t : Topology::kNoShell, from < to ? 1 : -1};
  });
  for (std::uint32_t low = 0; low < topology.positions; ++low)
    std::sort(
        rows.uses.data() + rows.offsets[low], rows.uses.data() + rows.offsets[low + 1],
        [](const Use& p, const Use& q) { return std::pair(p.other, p.triangle) < std::pair(q.other, q.triangle); });
  return rows;
}

/// One edge: notes whether it is open, and joins the two triangles that alone use it. The uses by degenerate triangles
/// come last.
void see_edge(std::uint32_t low, std::span<const Use> uses, DisjointSets& groups, Topology& topology) {
  int balance = 0;
  for (const Use& use : uses) balance += use.way;
  if (balance != 0) topology.open_edges.push_back({low, uses.front().other});
  const auto proper =
      std::count_if(uses.begin(), uses.end(), [](const Use& use) { return use.triangle != Topology::kNoShell; });
  if (proper == 2 && uses[0].way != uses[1].way) groups.join(uses[0].triangle, uses[1].triangle);
}

}  // namespace

Topology examine(const Body& body) {
  const MeshData& mesh = *body.placed.mesh;
  Topology topology;
  number_positions(body.world, topology);
  topology.shell.assign(body.size(), 0);
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    const Triangle triangle = body.triangle(t);
    if (exact::find_projection(triangle[0], triangle[1], triangle[2]) >= 0) continue;
    topology.shell[t] = Topology::kNoShell;
    ++topology.degenerate;
  }

  const Uses rows = uses_of(mesh, topology);
  DisjointSets groups(body.size());
  for (std::uint32_t low = 0; low < topology.positions; ++low) {
    const std::size_t end = rows.offsets[low + 1];
    for (std::size_t first = rows.offsets[low], last = first; first < end; first = last) {
      while (last < end && rows.uses[last].other == rows.uses[first].other) ++last;
      see_edge(low, std::span(rows.uses).subspan(first, last - first), groups, topology);
    }
  }
  // The least triangle of a shell comes first, and is the first to be numbered.
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    if (topology.shell[t] == Topology::kNoShell) continue;
    const std::uint32_t first = groups.find(t);
    topology.shell[t] = first == t ? topology.shells++ : topology.shell[first];
  }
  topology.closed = topology.open_edges.empty() && topology.shells > 0;
  return topology;
}

Fans fans_of(const Body& body, const Topology& topology) {
  const MeshData& mesh = *body.placed.mesh;
  const auto each = [&](const auto& take) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const std::uint32_t p = topology.position[a], q = topology.position[b], r = topology.position[c];
      take(p, t);
      if (q != p) take(q, t);
      if (r != p && r != q) take(r, t);
    }
  };
  Fans fans;
  fans.offsets.assign(topology.positions + 1, 0);
  each([&](std::uint32_t position, std::uint32_t) { ++fans.offsets[position + 1]; });
  for (std::size_t i = 1; i < fans.offsets.size(); ++i) fans.offsets[i] += fans.offsets[i - 1];
  fans.triangles.resize(fans.offsets.back());
  std::vector<std::uint32_t> next = fans.offsets;
  each([&](std::uint32_t position, std::uint32_t t) { fans.triangles[next[position]++] = t; });
  return fans;
}

}  // namespace impinge::solid
