// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/topology.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <tuple>

#include "core/disjoint_sets.hpp"
#include "core/point_table.hpp"
#include "exact/segment.hpp"

namespace impinge::solid {
namespace {

/// Numbers positions in the order of their first vertices.
void number_positions(std::span<const Vec3> world, Topology& topology) {
  PointTable table(world.size());
  topology.position.reserve(world.size());
  for (const Vec3& vertex : world) topology.position.push_back(table.add(vertex));
  topology.positions = table.size();
}

/// Lists the triangles around each position.
void list_fans(const Body& body, Topology& topology) {
  const auto each = [&](const auto& take) {
    for (std::uint32_t t = 0; t < body.size(); ++t) {
      const auto [p, q, r] = topology.corners(body, t);
      take(p, t);
      if (q != p) take(q, t);
      if (r != p && r != q) take(r, t);
    }
  };
  std::vector<std::uint32_t>& offsets = topology.fan_offsets;
  offsets.assign(topology.positions + 1, 0);
  each([&](std::uint32_t position, std::uint32_t) { ++offsets[position + 1]; });
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  topology.fan_triangles.resize(offsets.back());
  std::vector<std::uint32_t> next = offsets;
  each([&](std::uint32_t position, std::uint32_t t) { topology.fan_triangles[next[position]++] = t; });
}

/// The uses of all edges to higher positions, sorted by those.
void list_uses(const Body& body, const Topology& topology, std::uint32_t low, std::vector<EdgeUse>& uses) {
  uses.clear();
  for (const std::uint32_t t : topology.fan(low)) {
    const auto corners = topology.corners(body, t);
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
      if (from == to || std::min(from, to) != low) continue;
      uses.push_back({std::max(from, to), t, k, static_cast<std::int8_t>(from < to ? 1 : -1)});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& p, const EdgeUse& q) {
    return std::tie(p.high, p.triangle, p.k) < std::tie(q.high, q.triangle, q.k);
  });
}

/// Adds an edge to the open ones if it is open, and joins two proper triangles that alone use it.
void see_edge(std::uint32_t low, std::span<const EdgeUse> uses, DisjointSets& groups, Topology& topology) {
  int balance = 0, proper = 0;
  std::array<EdgeUse, 2> pair{};
  for (const EdgeUse& use : uses) {
    balance += use.way;
    if (!topology.is_proper(use.triangle)) continue;
    if (proper < 2) pair[static_cast<std::size_t>(proper)] = use;
    ++proper;
  }
  if (balance != 0) topology.open_edges.push_back({low, uses.front().high});
  if (proper == 2 && pair[0].way != pair[1].way) groups.join(pair[0].triangle, pair[1].triangle);
}

}  // namespace

Topology examine(const Body& body) {
  Topology topology;
  number_positions(body.world, topology);
  list_fans(body, topology);
  topology.shell.assign(body.size(), 0);
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    const Triangle triangle = body.triangle(t);
    if (exact::is_proper(triangle)) continue;
    topology.shell[t] = Topology::kNoShell;
    ++topology.degenerate;
  }

  DisjointSets groups(body.size());
  for_each_edge(body, topology,
                [&](std::uint32_t low, std::span<const EdgeUse> uses) { see_edge(low, uses, groups, topology); });
  // A set is named by its lowest triangle, which is also the first of its shell to be numbered.
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    if (!topology.is_proper(t)) continue;
    const std::uint32_t first = groups.find(t);
    topology.shell[t] = first == t ? topology.shells++ : topology.shell[first];
  }
  topology.closed = topology.open_edges.empty() && topology.shells > 0;
  return topology;
}

void for_each_edge(const Body& body, const Topology& topology, const VisitEdge& visit, const std::stop_token& stop) {
  std::vector<EdgeUse> uses;
  for (std::uint32_t low = 0; low < topology.positions && !stop.stop_requested(); ++low) {
    list_uses(body, topology, low, uses);
    for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
      while (last < uses.size() && uses[last].high == uses[first].high) ++last;
      visit(low, std::span(uses).subspan(first, last - first));
    }
  }
}

}  // namespace impinge::solid
