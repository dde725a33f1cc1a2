// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheet_ends.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "measure/triangle_distance.hpp"

namespace impinge::clash {
namespace {

/// Whether those of a part's triangles that have an edge in common with this one all go the same way from it as it
/// does.
bool is_end(const std::array<std::uint32_t, 2>& edge, const TriangleEdge& of, const LinkedPart& linked) {
  const auto& [offsets, triangles] = linked.fans;
  std::uint32_t at = edge[0], far = edge[1];
  if (offsets[far + 1] - offsets[far] < offsets[at + 1] - offsets[at]) std::swap(at, far);
  const auto fan = std::span(triangles).subspan(offsets[at], offsets[at + 1] - offsets[at]);
  return std::all_of(fan.begin(), fan.end(), [&](std::uint32_t t) {
    if (t == of.triangle || !linked.part.is_boundary(t)) return true;
    const auto corners = corners_of(linked.part, t);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
      if (((from == at && to == far) || (from == far && to == at)) && !go_one_way(linked.part, of, {t, k}))
        return false;
    }
    return true;
  });
}

/// Whether the surface ends there too as the whole part has it, which may go on in triangles that the sheets leave out.
bool is_end(const Sheets::End& end, const LinkedPart& linked) {
  const auto corners = corners_of(linked.part, end.of.triangle);
  return is_end(end.positions, end.of, linked) &&
         is_end({corners[end.of.corner], corners[(end.of.corner + 1) % 3]}, end.of, linked);
}

}  // namespace

SheetEnds::SheetEnds(const LinkedPart& part, const Sheets& sheets, const LocalFrame& frame) {
  std::vector<broad::BoxTree::Entry> entries;
  for (const Sheets::End& end : sheets.ends) {
    if (!is_end(end, part)) continue;
    ends_.push_back({frame.to_local(end.piece[0]), frame.to_local(end.piece[1])});
    const auto [lo, hi] = box_of(ends_.back());
    entries.push_back({{lo.x, lo.y, lo.z, -hi.x, -hi.y, -hi.z}, static_cast<std::uint32_t>(entries.size())});
  }
  tree_.build(entries);
}

bool SheetEnds::are_near(const Vec3& point, double distance) const {
  const Vec3 margin{distance, distance, distance};
  const std::array<std::uint32_t, 1> asked{0};
  const std::array<Box, 1> boxes{Box{point - margin, point + margin}};
  broad::BoxTree::Search search;
  tree_.find(asked, boxes, search);
  return std::any_of(search.found.begin(), search.found.end(), [&](std::uint64_t key) {
    const Segment& end = ends_[static_cast<std::uint32_t>(key)];
    return measure::point_distance(point, {end[0], end[1], end[1]}, distance).distance <= distance;
  });
}

}  // namespace impinge::clash
