// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

#include "impinge/predicates.hpp"

namespace impinge::cli {
namespace {

/// Whether predicates are exact on this number: below 2^300 and a multiple of 2^-358.
bool exact_on(double value) {
  if (!(std::fabs(value) < 0x1p300)) return false;
  const double multiple = std::ldexp(value, 358);
  return std::trunc(multiple) == multiple;
}

/// For each vertex the number of its position; equal positions have equal numbers (-0 equals 0).
std::vector<std::uint32_t> positions(const std::vector<Point>& vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) { return std::tie(vertices[i].x, vertices[i].y, vertices[i].z); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> position(vertices.size());
  for (std::size_t i = 1; i < order.size(); ++i)
    position[order[i]] = position[order[i - 1]] + (key(order[i]) == key(order[i - 1]) ? 0 : 1);
  return position;
}

/// Edges as sorted numbers, the lower position in the upper half: one list for each way that they are used.
struct Edges {
  std::vector<std::uint64_t> up, down;
};

Edges edges_of(const Mesh& mesh, const std::vector<std::uint32_t>& position) {
  Edges edges;
  for (const auto& triangle : mesh.triangles()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t from = position[triangle[i]], to = position[triangle[(i + 1) % 3]];
      if (from < to) edges.up.push_back(from << 32 | to);
      if (from > to) edges.down.push_back(to << 32 | from);
    }
  }
  std::sort(edges.up.begin(), edges.up.end());
  std::sort(edges.down.begin(), edges.down.end());
  return edges;
}

std::uint64_t count_open(const Edges& edges) {
  std::uint64_t open = 0;
  std::size_t u = 0, d = 0;
  while (u < edges.up.size() || d < edges.down.size()) {
    const std::uint64_t edge = d == edges.down.size()                                ? edges.up[u]
                               : u == edges.up.size() || edges.down[d] < edges.up[u] ? edges.down[d]
                                                                                     : edges.up[u];
    const std::size_t u_before = u, d_before = d;
    while (u < edges.up.size() && edges.up[u] == edge) ++u;
    while (d < edges.down.size() && edges.down[d] == edge) ++d;
    open += u - u_before != d - d_before ? 1 : 0;
  }
  return open;
}

}  // namespace

Surface inspect(const Mesh& mesh, const Pose& pose) {
  Surface surface;
  std::vector<Point> world;
  world.reserve(mesh.vertex_count());
  for (const Point& vertex : mesh.vertices()) world.push_back(world_vertex(pose, vertex));
  for (const auto& triangle : mesh.triangles())
    for (const std::uint32_t v : triangle)
      if (!exact_on(world[v].x) || !exact_on(world[v].y) || !exact_on(world[v].z)) surface.in_domain = false;
  if (!surface.in_domain) return surface;

  for (const auto& [a, b, c] : mesh.triangles())
    surface.degenerate += is_degenerate(Triangle{world[a], world[b], world[c]}) ? 1 : 0;
  surface.open_edges = count_open(edges_of(mesh, positions(world)));
  surface.closed = surface.open_edges == 0 && surface.degenerate < mesh.triangle_count();
  return surface;
}

}  // namespace impinge::cli
