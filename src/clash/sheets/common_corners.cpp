// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/common_corners.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "clash/point_grid.hpp"
#include "core/local_frame.hpp"

namespace impinge::clash {
namespace {

struct BorderCorner {
  Vec3 at{};
  double shortest = std::numeric_limits<double>::infinity();  ///< of the edges that begin or end there
};

}  // namespace

CornerReach::CornerReach(const solid::Part& part, double of) : tolerance(of) {
  // A motion rounds world vertices, and a file may hold single precision.
  const Box& box = part.body.box;
  noise = std::min(tolerance, 0x1p-20 * norm(box.hi - box.lo) + 0x1p-48 * largest_coordinate(box));
}

double CornerReach::beside(double length) const {
  constexpr double kLong = 16;
  return length > kLong * tolerance ? tolerance : noise;
}

CommonCorners::CommonCorners(std::span<const Edge> edges, const CornerReach& reach) {
  if (reach.tolerance == 0) return;
  std::map<std::uint32_t, BorderCorner> corners;
  for (const Edge& edge : edges)
    if (edge.is_border) corners[edge.from].at = edge.at[0], corners[edge.to].at = edge.at[1];
  for (const Edge& edge : edges)
    for (const std::uint32_t end : {edge.from, edge.to})
      if (const auto corner = corners.find(end); corner != corners.end())
        corner->second.shortest = std::min(corner->second.shortest, norm(edge.at[1] - edge.at[0]));
  PointGrid grid(reach.tolerance);
  for (const auto& each : corners) {
    const std::uint32_t position = each.first;
    const BorderCorner& corner = each.second;
    const auto may_stand = [&](const Vec3& at, std::uint32_t other) {
      const double shortest = std::min(corner.shortest, corners[other].shortest);
      if (norm(at - corner.at) > reach.beside(shortest)) return false;
      stands_.emplace(position, other);
      return true;
    };
    grid.find(corner.at, may_stand);
    if (!stands_.contains(position)) grid.add(corner.at, position);
  }
}

}  // namespace impinge::clash
