// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/edge_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "clash/local_frame.hpp"
#include "core/shapes.hpp"
#include "exact/segment.hpp"

namespace impinge::clash {
namespace {

int longest_axis(const Vec3& way) {
  const double x = std::abs(way.x), y = std::abs(way.y), z = std::abs(way.z);
  if (x >= y && x >= z) return 0;
  return y >= z ? 1 : 2;
}

bool is_on(const Vec3& point, const Segment& edge, double within) {
  if (within == 0) return exact::intersects(point, edge);
  const Vec3 way = edge[1] - edge[0], to_point = point - edge[0];
  const double length = norm(way), along = dot(to_point, way) / length;
  return along > within && along < length - within && norm(cross(to_point, way)) <= within * length;
}

}  // namespace

EdgeCuts::EdgeCuts(const solid::Part& part, const std::vector<std::uint32_t>& ids, const CornerReach& reach)
    : reach_(reach), rounding_(0x1p-40 * largest_coordinate(part.body.box)) {  // far more than the tree's own
  for (const std::uint32_t id : ids)
    for (const std::uint32_t v : part.body.placed.mesh->triangles[id])
      corners_.push_back({part.topology.position[v], part.body.world[v]});
  const auto by_position = [](const Corner& p, const Corner& q) { return p.position < q.position; };
  std::sort(corners_.begin(), corners_.end(), by_position);
  const auto are_one = [](const Corner& p, const Corner& q) { return p.position == q.position; };
  corners_.erase(std::unique(corners_.begin(), corners_.end(), are_one), corners_.end());
  order_.resize(corners_.size()), axis_.resize(corners_.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  build({0, static_cast<std::uint32_t>(order_.size())});
}

std::vector<std::uint32_t> EdgeCuts::along(std::uint32_t from, std::uint32_t to) const {
  const Vec3 start = at(from), end = at(to);
  const double within = reach_.beside(norm(end - start));
  std::vector<std::uint32_t> found;
  find({0, static_cast<std::uint32_t>(order_.size())}, {from, to, {start, end}, within, start, end}, found);
  const int axis = longest_axis(end - start);
  const double way = component(end, axis) > component(start, axis) ? 1 : -1;
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

void EdgeCuts::build(Range range) {
  if (range.last - range.first < 2) return;
  Box box{corners_[order_[range.first]].at, corners_[order_[range.first]].at};
  for (std::uint32_t i = range.first; i < range.last; ++i)
    box.lo = min(box.lo, corners_[order_[i]].at), box.hi = max(box.hi, corners_[order_[i]].at);
  const int axis = longest_axis(box.hi - box.lo);
  const std::uint32_t middle = range.first + (range.last - range.first) / 2;
  std::nth_element(order_.begin() + range.first, order_.begin() + middle, order_.begin() + range.last,
                   [&](std::uint32_t p, std::uint32_t q) {
                     return component(corners_[p].at, axis) < component(corners_[q].at, axis);
                   });
  axis_[middle] = static_cast<std::uint8_t>(axis);
  build({range.first, middle}), build({middle + 1, range.last});
}

/// Of each half of the tree only the piece of the edge is looked at that is in it: there are few corners close to it,
/// though the box of a long edge may hold them all.
void EdgeCuts::find(Range range, const Piece& piece, std::vector<std::uint32_t>& found) const {
  if (range.first == range.last) return;
  const std::uint32_t middle = range.first + (range.last - range.first) / 2;
  const auto& [position, point] = corners_[order_[middle]];
  if (position != piece.from && position != piece.to && is_on(point, piece.edge, piece.within))
    found.push_back(position);
  const int axis = axis_[middle];
  const double split = component(point, axis), a = component(piece.start, axis), b = component(piece.end, axis);
  for (const double side : {-1.0, 1.0}) {
    const double border = split - side * (piece.within + rounding_);
    const bool has_start = side * (a - border) >= 0, has_end = side * (b - border) >= 0;
    if (!has_start && !has_end) continue;
    Piece half = piece;
    if (!has_start || !has_end)
      (has_start ? half.end : half.start) = piece.start + (border - a) / (b - a) * (piece.end - piece.start);
    find(side < 0 ? Range{range.first, middle} : Range{middle + 1, range.last}, half, found);
  }
}

}  // namespace impinge::clash
