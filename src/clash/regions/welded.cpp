// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/welded.hpp"

#include <algorithm>

#include "clash/point_grid.hpp"
#include "clash/regions/lines.hpp"
#include "core/point_table.hpp"
#include "core/stopped.hpp"

namespace impinge::clash {
namespace {

/// How many tolerances a corner may be from an edge on which it lies: it is half-way across a gap, and was moved.
constexpr double kReach = 1.5;

/// Where corners move to.
struct Moves {
  PointTable from;
  std::vector<Vec3> to;  ///< for each of those
};

Moves find_moves(std::span<const Corner> corners, double within, const std::stop_token& stop) {
  std::vector<Vec3> points;
  points.reserve(corners.size());
  for (const Corner& corner : corners) points.push_back(corner.point);
  std::sort(points.begin(), points.end(), until_stopped(stop, less));
  points.erase(std::unique(points.begin(), points.end()), points.end());
  PointGrid chosen(within);
  Moves moves;
  for (const Vec3& point : points) {
    throw_if_stopped(stop);
    Vec3 to = point;
    chosen.find(point, [&](const Vec3& other, std::uint32_t) { return to = other, true; });
    if (to == point) chosen.add(point, 0);
    moves.from.add(point);
    moves.to.push_back(to);
  }
  return moves;
}

double distance(const Vec3& p, const Segment& edge) {
  const Vec3 along = edge[1] - edge[0], from = p - edge[0];
  const double square = dot(along, along);
  const double share = square > 0 ? std::clamp(dot(from, along) / square, 0.0, 1.0) : 0;
  return norm(from - share * along);
}

unsigned edges_near(const Vec3& p, const Triangle& t, double within) {
  unsigned edges = 0;
  for (unsigned i = 0; i < 3; ++i)
    if (distance(p, {t[i], t[(i + 1) % 3]}) <= within) edges |= 1U << i;
  return edges;
}

}  // namespace

// Gaps may exceed the resolution, though not the tolerance.
double welding_distance(const SharedParts& parts, const Reach& reach) {
  return 1.25 * std::min(parts.gap(), reach.resolution) + 0x1p-8 * reach.resolution;
}

SharedParts welded(const solid::Body& a, const solid::Body& b, std::span<const exact::Contact> contacts,
                   const SharedParts& parts, const Reach& reach, const std::stop_token& stop) {
  const Moves moves = find_moves(parts.corners(), welding_distance(parts, reach), stop);
  SharedParts result;
  result.reserve(contacts.size());
  std::vector<Corner> row;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    throw_if_stopped(stop);
    const Triangle of_a = a.triangle(contacts[i].a), of_b = b.triangle(contacts[i].b);
    row.clear();
    for (const Corner& corner : parts[i]) {
      const Vec3 point = moves.to[*moves.from.find(corner.point)];
      if (!row.empty() && (row.front().point == point || row.back().point == point)) continue;
      const unsigned edges =
          edges_near(point, of_a, kReach * reach.tolerance) | edges_near(point, of_b, kReach * reach.tolerance) << 3;
      row.push_back({point, static_cast<std::uint8_t>(edges)});
    }
    if (row.size() == 1) {
      result.add_vertex(row[0]);
    } else {
      result.add(row);
    }
  }
  return result;
}

}  // namespace impinge::clash
