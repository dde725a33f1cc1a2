// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/sheets/edge_pseudonormal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "clash/sheets/sheets.hpp"

namespace impinge::clash {
namespace {

/// What is beyond an edge.
struct EdgeNeighbor {
  Triangle local;
  std::size_t apex;  ///< the corner that is not on the edge
  int turn;          ///< -1 where its normal looks the other way
};

/// The one other boundary triangle at the edge from a corner to the next; nothing if there are none or several.
/// Triangles with the same corners count as one.
std::optional<EdgeNeighbor> neighbor(const PartTriangle& triangle, std::size_t edge) {
  const solid::Part& part = triangle.part;
  const auto own = part.corners(triangle.id);
  const std::uint32_t own_apex = own[(edge + 2) % 3];
  std::optional<EdgeNeighbor> found;
  std::uint32_t apex = own_apex;
  bool is_only = true;
  part.topology.for_each_use(part.body, own[edge], own[(edge + 1) % 3], [&](std::uint32_t t, std::uint32_t corner) {
    if (t == triangle.id || !part.is_boundary(t)) return;
    const auto corners = part.corners(t);
    const std::uint32_t next_apex = corners[(corner + 2) % 3];
    if (next_apex == own_apex || (found && next_apex == apex)) return;
    if (found) is_only = false;
    apex = next_apex;
    const int turn = corners[corner] == own[edge] ? -1 : 1;
    found = {triangle.frame.to_local(part.body.triangle(t)), (corner + 2) % 3, turn};
  });
  return is_only ? found : std::nullopt;
}

/// Of unit length; nothing where it may be off by more than 2^-20 (see make_slab).
std::optional<Vec3> normal(const Triangle& t, double scale) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double length = norm(n), longest = std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
  if (!(length > 0x1p-30 * longest * (longest + scale))) return std::nullopt;
  return (1 / length) * n;
}

/// Where both normals are known: the triangle's, and the neighbor's turned as the triangle is.
std::optional<std::array<Vec3, 2>> normals(const PartTriangle& triangle, const EdgeNeighbor& next) {
  const auto own = normal(triangle.local, triangle.frame.scale), other = normal(next.local, triangle.frame.scale);
  if (!own || !other) return std::nullopt;
  return std::array{*own, next.turn * *other};
}

/// `away` is the way from the edge to what has its nearest point there, at a right angle to it.
std::uint8_t side_at_edge(const PartTriangle& triangle, std::size_t edge, const Vec3& away) {
  const auto next = neighbor(triangle, edge);
  if (!next || dot(away, next->local[next->apex] - triangle.local[edge]) > 0) return 0;
  const auto up = normals(triangle, *next);
  if (!up) return 0;
  // The normals of what is folded up flat cancel out.
  const double height = dot((*up)[0] + (*up)[1], away);
  if (!(std::abs(height) > 0x1p-10 * norm(away))) return 0;
  return height > 0 ? kAbove : kBelow;
}

}  // namespace

bool is_bent_around(const PartTriangle& triangle) {
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const auto next = neighbor(triangle, edge);
    const auto up = next ? normals(triangle, *next) : std::nullopt;
    if (up && norm((*up)[1] - (*up)[0]) > 0x1p-6) return true;
  }
  return false;
}

std::uint8_t edge_pseudonormal_side(const PartTriangle& triangle, const Vec3& point, double beyond) {
  const Triangle& t = triangle.local;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 along = t[(i + 1) % 3] - t[i], inward = t[(i + 2) % 3] - t[i], to_point = point - t[i];
    const double share = dot(to_point, along) / dot(along, along);
    const Vec3 away = to_point - share * along;
    if (share > 0 && share < 1 && dot(away, inward) < 0)
      return norm(away) > beyond ? side_at_edge(triangle, i, away) : std::uint8_t{0};
  }
  return 0;
}

}  // namespace impinge::clash
