// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/part.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "report/text.hpp"
#include "report/vector.hpp"

namespace impinge::report {
namespace {

/// A point where two triangles that meet can be looked for: the middle of what their boxes share. That is not empty.
Point near_both(const Mesh& mesh, const Pose& pose, const TrianglePair& pair) {
  const auto bounds = [&](std::uint32_t triangle) {
    Bounds box;
    for (const std::uint32_t corner : mesh.triangles()[triangle]) box.add(world_vertex(pose, mesh.vertices()[corner]));
    return box;
  };
  const Bounds both = shared(bounds(pair.a), bounds(pair.b));
  return middle(both.lo, both.hi);
}

/// "0.500" as "0.5": three places side by side are long enough.
std::string short_coordinate(double value, double size) {
  std::string text = coordinate(value, size);
  if (text.find('.') == std::string::npos || text.find('e') != std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string place(const Point& point, double size) {
  return fmt::format("({} {} {})", short_coordinate(point.x, size), short_coordinate(point.y, size),
                     short_coordinate(point.z, size));
}

std::string in(std::string_view unit) { return unit.empty() ? "" : fmt::format(" {}", unit); }

std::string first_at(const std::optional<Segment>& edge, double size, std::string_view unit) {
  return edge ? fmt::format(", first at {}-{}{}", place((*edge)[0], size), place((*edge)[1], size), in(unit)) : "";
}

}  // namespace

Part describe(const PartFacts& facts, const Mesh& mesh, const Pose& pose) {
  Part part{facts, std::nullopt, mesh.sphere_radius()};
  if (facts.self_crossing) part.crossing_near = near_both(mesh, pose, *facts.self_crossing);
  return part;
}

std::string coordinate(double value, double size) {
  const double decimals = size > 0 ? 3 - std::floor(std::log10(size)) : 3;
  if (!(decimals <= 9) || !(decimals >= -6) || !(std::fabs(value) < 1e9)) return fmt::format("{:.5g}", value + 0.0);
  std::string text = fmt::format("{:.{}f}", value, static_cast<int>(std::max(decimals, 0.0)));
  if (text.find_first_of("123456789") == std::string::npos && text.front() == '-') text.erase(0, 1);
  return text;
}

std::string facts_text(const Part& part, std::string_view unit) {
  const PartFacts& facts = part.facts;
  std::vector<std::string> texts;
  if (facts.open_edges > 0)
    texts.push_back(counted(facts.open_edges, "open edge") + first_at(facts.open_edge, part.size, unit));
  if (facts.unclear_edges > 0)
    texts.push_back(facts.unclear_edges == facts.open_edges
                        ? "at none of them can inside be told from outside"
                        : fmt::format("at {} of them inside cannot be told from outside{}",
                                      grouped(facts.unclear_edges), first_at(facts.unclear_edge, part.size, unit)));
  if (facts.self_crossings > 0) {
    texts.push_back(counted(facts.self_crossings, "self-crossing"));
    if (part.crossing_near)
      texts.back() += fmt::format(", first near {}{}", place(*part.crossing_near, part.size), in(unit));
  }
  if (facts.turned > 0) texts.push_back(counted(facts.turned, "triangle") + " turned");
  return texts.empty() ? "it encloses nothing" : fmt::format("{}", fmt::join(texts, "; "));
}

}  // namespace impinge::report
