// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/pieces.hpp"

#include <algorithm>
#include <utility>

#include "core/disjoint_sets.hpp"

namespace impinge::solid {
namespace {

void join_corners(const Body& body, const Topology& topology, std::uint32_t t, DisjointSets& positions) {
  const auto [p, q, r] = topology.corners(body, t);
  positions.join(p, q), positions.join(p, r);
}

}  // namespace

std::vector<OpenEdge> open_edges_of(const Body& body, const Topology& topology, const Orientation& orientation,
                                    const std::stop_token& stop) {
  std::vector<OpenEdge> open;
  const auto see = [&](std::uint32_t /*low*/, std::span<const EdgeUse> uses) {
    int balance = 0;
    const EdgeUse* first = nullptr;
    for (const EdgeUse& use : uses) {
      if (orientation.patch[use.triangle] == Orientation::kNoPatch) continue;
      balance += orientation.is_turned[use.triangle] ? -use.way : use.way;
      if (first == nullptr) first = &use;
    }
    if (balance != 0) open.push_back({first->triangle, first->k});
  };
  for_each_edge(body, topology, see, stop);
  return open;
}

std::vector<std::vector<std::uint32_t>> components_of(const Body& body, const Topology& topology,
                                                      std::span<const std::uint32_t> triangles) {
  DisjointSets positions(topology.positions);
  for (const std::uint32_t t : triangles) join_corners(body, topology, t, positions);
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> number(topology.positions, kNone);
  std::vector<std::vector<std::uint32_t>> components;
  for (const std::uint32_t t : triangles) {
    std::uint32_t& own = number[positions.find(topology.corners(body, t)[0])];
    if (own == kNone) own = static_cast<std::uint32_t>(components.size()), components.emplace_back();
    components[own].push_back(t);
  }
  return components;
}

std::vector<Piece> pieces_of(const Body& body, const Topology& topology, const Orientation& orientation,
                             const std::stop_token& stop) {
  const auto is_left_out = [&](std::uint32_t t) { return orientation.patch[t] == Orientation::kNoPatch; };
  DisjointSets positions(topology.positions);
  std::vector<std::uint32_t> corner_of_patch(orientation.is_closed.size());
  std::vector<bool> is_used(topology.positions);
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    if (is_left_out(t)) continue;
    join_corners(body, topology, t, positions);
    for (const std::uint32_t p : topology.corners(body, t)) is_used[p] = true;
    corner_of_patch[orientation.patch[t]] = topology.corners(body, t)[0];
  }
  for (std::size_t p = 0; p < corner_of_patch.size(); ++p)
    positions.join(corner_of_patch[p], corner_of_patch[orientation.outermost[p]]);
  std::vector<bool> is_open(topology.positions);
  for (const OpenEdge& edge : open_edges_of(body, topology, orientation, stop))
    is_open[positions.find(topology.corners(body, edge.triangle)[0])] = true;

  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> number(topology.positions, kNone);
  std::vector<Piece> pieces;
  Piece rest;
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    if (is_left_out(t)) {
      // A segment or point belongs to what is not closed, unless it hangs on something closed; a repeated triangle to
      // nothing.
      const auto at = topology.corners(body, t);
      const bool is_segment = at[0] == at[1] || at[1] == at[2] || at[2] == at[0];
      const auto is_of_closed = [&](std::uint32_t p) { return is_used[p] && !is_open[positions.find(p)]; };
      if (is_segment && std::none_of(at.begin(), at.end(), is_of_closed)) rest.triangles.push_back(t);
      continue;
    }
    const std::uint32_t set = positions.find(topology.corners(body, t)[0]);
    if (is_open[set]) {
      rest.triangles.push_back(t);
      continue;
    }
    if (number[set] == kNone) number[set] = static_cast<std::uint32_t>(pieces.size()), pieces.push_back({{}, true});
    pieces[number[set]].triangles.push_back(t);
  }
  if (!rest.triangles.empty()) pieces.push_back(std::move(rest));
  return pieces;
}

}  // namespace impinge::solid
