// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/known_part.hpp"

#include <cmath>

#include "clash/local_frame.hpp"

namespace impinge::clash {
namespace {

/// Of its triangles, and of what its shells enclose.
void measure(const solid::Part& part, PartFacts& facts) {
  const LocalFrame frame = local_frame(part.body.box, part.body.box);
  double area = 0, volume = 0;
  for (std::uint32_t t = 0; t < part.body.size(); ++t) {
    const Triangle triangle = frame.to_local(part.body.triangle(t));
    const Vec3 normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    area += norm(normal) / 2;
    const std::uint32_t shell = part.topology.shell[t];
    if (!part.solid || shell == solid::Topology::kNoShell) continue;
    const auto [front, back] = part.sides[shell];
    if (front != back) volume += (back ? 1 : -1) * dot(triangle[0], normal) / 6;
  }
  facts.area = area / frame.unit / frame.unit;
  facts.volume = std::abs(volume) / frame.unit / frame.unit / frame.unit;
  if (part.solid && area > 0) facts.wall = 2 * std::abs(volume) / area / frame.unit;
}

Segment place_of(const std::array<std::uint32_t, 2>& edge, const solid::Part& part) {
  Segment segment{};
  for (std::size_t v = 0; v < part.body.world.size(); ++v)
    for (std::size_t end = 0; end < 2; ++end)
      if (part.topology.position[v] == edge[end]) segment[end] = part.body.world[v];
  return segment;
}

}  // namespace

KnownPart know(solid::Body body, const std::vector<TrianglePair>& defects) {
  solid::Topology topology = solid::examine(body);
  const bool is_solid = topology.closed && defects.empty();
  KnownPart known;
  known.linked.part = solid::make_part(std::move(body), std::move(topology), is_solid);
  const solid::Part& part = known.linked.part;
  known.linked.fans = solid::fans_of(part.body, part.topology);
  PartFacts& facts = known.facts;
  facts.solid = is_solid, facts.closed = part.topology.closed;
  facts.open_edges = part.topology.open_edges.size();
  facts.self_crossings = defects.size();
  if (!part.topology.open_edges.empty()) facts.open_edge = place_of(part.topology.open_edges[0], part);
  if (!defects.empty()) facts.self_crossing = defects[0];
  measure(part, facts);
  return known;
}

}  // namespace impinge::clash
