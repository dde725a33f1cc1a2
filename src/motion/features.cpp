// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/features.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "core/point_table.hpp"
#include "core/stopped.hpp"

namespace impinge::motion {

Features::Features(std::vector<Corners> triangles)
    : corners(std::move(triangles)), sides(corners.size()), care(corners.size()) {
  // By the larger vertex first, which are counted; then the few of each.
  struct Side {
    std::uint32_t smaller, triangle;
    std::uint8_t side;
    auto operator<=>(const Side&) const = default;
  };
  std::uint32_t vertices = 0;
  for (const Corners& c : corners) vertices = std::max({vertices, c[0] + 1, c[1] + 1, c[2] + 1});
  const auto for_each_side = [&](const auto& visit) {
    for (std::uint32_t i = 0; i < corners.size(); ++i)
      for (std::uint8_t k = 0; k < 3; ++k)
        if (const std::uint32_t one = corners[i][k], two = corners[i][(k + 1) % 3]; one != two)
          visit(std::max(one, two), Side{std::min(one, two), i, k});
  };
  std::vector<std::size_t> ends(std::size_t{vertices} + 1);  // of each vertex; while they are put, where the next comes
  for_each_side([&](std::uint32_t larger, const Side&) { ++ends[larger + 1]; });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Side> all(ends.back());
  for_each_side([&](std::uint32_t larger, const Side& side) { all[ends[larger]++] = side; });
  for (Corners& of : sides) of = {kNone, kNone, kNone};
  auto next = all.begin();
  for (std::uint32_t larger = 0; larger < vertices; ++larger) {
    const auto first = next, end = all.begin() + static_cast<std::ptrdiff_t>(ends[larger]);
    std::sort(first, end);
    for (; next != end; ++next) {
      if (next == first || next->smaller != std::prev(next)->smaller) {
        edges.push_back({larger, next->smaller});
        care[next->triangle] |= static_cast<std::uint8_t>(8 << next->side);
      }
      sides[next->triangle][next->side] = static_cast<std::uint32_t>(edges.size() - 1);
    }
  }
  std::vector<bool> seen(vertices);
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      if (seen[corners[i][k]]) continue;
      seen[corners[i][k]] = true;
      care[i] |= static_cast<std::uint8_t>(1 << k);
    }
}

Neighbours::Neighbours(const Features& features) : features_(features) {
  std::uint32_t vertices = 0;
  for (const Corners& c : features.corners) vertices = std::max({vertices, c[0] + 1, c[1] + 1, c[2] + 1});
  offsets_.resize(std::size_t{vertices} + 1);
  for (const Corners& corners : features.corners)
    for (const std::uint32_t vertex : corners) ++offsets_[vertex + 1];
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  triangles_.resize(offsets_.back());
  std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::uint32_t i = 0; i < features.corners.size(); ++i)
    for (const std::uint32_t vertex : features.corners[i]) triangles_[next[vertex]++] = i;
}

bool Neighbours::vertex_and_face(std::uint32_t vertex, std::uint32_t face) const {
  return std::ranges::any_of(triangles_of(vertex), [&](std::uint32_t i) { return share_corner(i, face); });
}

bool Neighbours::edges(std::uint32_t one, std::uint32_t other) const {
  const auto any_triangle = [&](std::uint32_t edge, const auto& is) {
    auto [start, end] = features_.edges[edge];
    if (triangles_of(end).size() < triangles_of(start).size()) std::swap(start, end);
    return std::ranges::any_of(triangles_of(start), [&, end](std::uint32_t i) {
      return std::ranges::find(features_.corners[i], end) != features_.corners[i].end() && is(i);
    });
  };
  return any_triangle(
      one, [&](std::uint32_t i) { return any_triangle(other, [&](std::uint32_t j) { return share_corner(i, j); }); });
}

bool Neighbours::share_corner(std::uint32_t one, std::uint32_t other) const {
  const Corners& corners = features_.corners[one];
  return std::ranges::find_first_of(corners, features_.corners[other]) != corners.end();
}

std::optional<Features> join_equal_vertices(const Features& of, std::span<const Vec3> from, std::span<const Vec3> to,
                                            const std::stop_token& stop) {
  PointTable starts(from.size());
  std::vector<std::uint32_t> start;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (i % 4096 == 0) throw_if_stopped(stop);
    start.push_back(starts.add(from[i]));
  }
  if (starts.size() == from.size()) return std::nullopt;  // each vertex is its own
  PointTable ends(to.size()), pairs(to.size());
  std::vector<std::uint32_t> first_of, lowest;
  for (std::uint32_t i = 0; i < to.size(); ++i) {
    if (i % 4096 == 0) throw_if_stopped(stop);
    const std::uint32_t pair = pairs.add({double(start[i]), double(ends.add(to[i])), 0});
    if (pair == first_of.size()) first_of.push_back(i);
    lowest.push_back(first_of[pair]);
  }
  if (first_of.size() == to.size()) return std::nullopt;
  std::vector<Corners> triangles = of.corners;
  for (Corners& corners : triangles)
    for (std::uint32_t& corner : corners) corner = lowest[corner];

  Features joined(std::move(triangles));
  // In order of the first of the edges that each was.
  std::vector<std::uint32_t> first(joined.edges.size(), Features::kNone), by_name(joined.edges.size());
  for (std::size_t i = 0; i < joined.sides.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (const std::uint32_t edge = joined.sides[i][k]; edge != Features::kNone)
        first[edge] = std::min(first[edge], of.sides[i][k]);
  std::iota(by_name.begin(), by_name.end(), 0);
  std::sort(by_name.begin(), by_name.end(), [&](std::uint32_t i, std::uint32_t j) { return first[i] < first[j]; });
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::uint32_t> now(joined.edges.size());
  for (const std::uint32_t edge : by_name) {
    now[edge] = static_cast<std::uint32_t>(edges.size());
    edges.push_back(joined.edges[edge]);
    joined.names.push_back(first[edge]);
  }
  joined.edges = std::move(edges);
  for (Corners& sides : joined.sides)
    for (std::uint32_t& edge : sides)
      if (edge != Features::kNone) edge = now[edge];
  return joined;
}

}  // namespace impinge::motion
