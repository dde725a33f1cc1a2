// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/edge_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/local_frame.hpp"
#include "core/shapes.hpp"
#include "exact/segment.hpp"

namespace impinge::clash {
namespace {

bool is_on(const Vec3& point, const Segment& edge, double within) {
  if (within == 0) return exact::intersects(point, edge);
  const Vec3 way = edge[1] - edge[0], to_point = point - edge[0];
  const double length = norm(way), along = dot(to_point, way) / length;
  return along > within && along < length - within && norm(cross(to_point, way)) <= within * length;
}

template <class Corners>
std::vector<Vec3> points_of(const Corners& corners) {
  std::vector<Vec3> points;
  points.reserve(corners.size());
  for (const auto& corner : corners) points.push_back(corner.at);
  return points;
}

}  // namespace

std::vector<EdgeCuts::Corner> EdgeCuts::corners_of(const solid::Part& part, const std::vector<std::uint32_t>& ids) {
  std::vector<Corner> corners;
  for (const std::uint32_t id : ids)
    for (const std::uint32_t v : part.body.placed.mesh->triangles[id])
      corners.push_back({part.topology.position[v], part.body.world[v]});
  const auto by_position = [](const Corner& p, const Corner& q) { return p.position < q.position; };
  std::sort(corners.begin(), corners.end(), by_position);
  const auto are_one = [](const Corner& p, const Corner& q) { return p.position == q.position; };
  corners.erase(std::unique(corners.begin(), corners.end(), are_one), corners.end());
  return corners;
}

EdgeCuts::EdgeCuts(const solid::Part& part, const std::vector<std::uint32_t>& ids, const CornerReach& reach)
    : reach_(reach),
      rounding_(0x1p-40 * largest_coordinate(part.body.box)),  // far more than the tree's own
      corners_(corners_of(part, ids)),
      tree_(points_of(corners_)) {}

std::vector<std::uint32_t> EdgeCuts::along(std::uint32_t from, std::uint32_t to) const {
  const Segment edge{at(from), at(to)};
  const Vec3 step = edge[1] - edge[0];
  const double within = reach_.beside(norm(step));
  std::vector<std::uint32_t> found;
  tree_.near(edge, within + rounding_, [&](std::uint32_t i) {
    const auto& [position, point] = corners_[i];
    if (position != from && position != to && is_on(point, edge, within)) found.push_back(position);
  });
  const int axis = longest_axis(step);
  const double way = component(step, axis) > 0 ? 1 : -1;
  std::sort(found.begin(), found.end(), [&](std::uint32_t p, std::uint32_t q) {
    return way * component(at(p), axis) < way * component(at(q), axis);
  });
  found.insert(found.begin(), from), found.push_back(to);
  return found;
}

const EdgeCuts::Corner& EdgeCuts::corner(std::uint32_t position) const {
  return *std::lower_bound(corners_.begin(), corners_.end(), position,
                           [](const Corner& corner, std::uint32_t p) { return corner.position < p; });
}

}  // namespace impinge::clash
