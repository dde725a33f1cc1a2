// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/measured_part.hpp"

#include <algorithm>
#include <cmath>

#include "clash/wall.hpp"
#include "core/local_frame.hpp"

namespace impinge::clash {
namespace {

/// Measures the triangles and what the shells enclose; the volume of a cavity is negative.
void measure(MeasuredPart& measured) {
  const solid::Part& part = measured.part;
  const LocalFrame frame = local_frame(part.body.box, part.body.box);
  AreaAndVolume whole;
  std::vector<AreaAndVolume> shells(part.topology.shells);
  for (std::uint32_t t = 0; t < part.body.size(); ++t) {
    const Triangle triangle = frame.to_local(part.body.triangle(t));
    whole.add(triangle);
    if (part.solid && part.is_boundary(t)) shells[part.topology.shell[t]].add(triangle, part.is_inward(t) ? -1 : 1);
  }
  whole.volume = 0;
  double thinnest = kInfinity;
  for (const AreaAndVolume& shell : shells) {
    whole.volume += shell.volume;
    if (shell.volume > 0) thinnest = std::min(thinnest, shell.wall());
  }
  PartFacts& facts = measured.facts;
  facts.area = whole.area / frame.unit / frame.unit;
  if (!part.solid) return;
  facts.volume = std::abs(whole.volume) / frame.unit / frame.unit / frame.unit;
  facts.wall = whole.wall() / frame.unit;
  measured.thinnest_wall = std::min(thinnest, whole.wall()) / frame.unit;
}

Segment place_of(const std::array<std::uint32_t, 2>& edge, const solid::Part& part) {
  Segment segment{};
  for (std::size_t v = 0; v < part.body.world.size(); ++v)
    for (std::size_t end = 0; end < 2; ++end)
      if (part.topology.position[v] == edge[end]) segment[end] = part.body.world[v];
  return segment;
}

}  // namespace

MeasuredPart measured_part(solid::Body body, const Defects& defects) {
  solid::Topology topology = solid::examine(body);
  const bool is_solid = topology.closed && defects.count == 0;
  MeasuredPart measured;
  measured.part = solid::make_part(std::move(body), std::move(topology), is_solid);
  const solid::Part& part = measured.part;
  PartFacts& facts = measured.facts;
  facts.solid = is_solid, facts.closed = part.topology.closed;
  facts.open_edges = part.topology.open_edges.size();
  facts.degenerate = part.topology.degenerate;
  facts.self_crossings = defects.count, facts.self_crossing = defects.first;
  if (!part.topology.open_edges.empty()) facts.open_edge = place_of(part.topology.open_edges[0], part);
  measure(measured);
  measured.deep_points = deep_points(part, measured.thinnest_wall / 4);  // no larger tolerance is applied
  return measured;
}

}  // namespace impinge::clash
