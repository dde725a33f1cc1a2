// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/manifold/inner_vertices.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace impinge::clash {
namespace {

/// Lines that a way meets within this share of it are met at once.
constexpr double kTogether = 0x1p-20;

bool is_on(const SharedPoints& line, const Vec3& p) {
  const Vec3 along = line.points[line.size - 1] - line.points[0], way = p - line.points[0];
  const double square = dot(along, along), at = square > 0 ? std::clamp(dot(way, along) / square, 0.0, 1.0) : 0;
  return norm(way - at * along) <= kRounding;
}

}  // namespace

void InnerVertices::restart(const std::array<PlacedSurface, 2>& surfaces, std::span<const Touch> touches) {
  surfaces_ = surfaces, touches_ = touches;
  seeds_.clear();
  order_.resize(touches.size());
  std::iota(order_.begin(), order_.end(), 0u);
  for (const int side : {0, 1}) {
    const auto triangle = [&](std::uint32_t i) { return touches[i].triangles[static_cast<std::size_t>(side)]; };
    if (side == 1)
      std::sort(order_.begin(), order_.end(), [&](std::uint32_t i, std::uint32_t j) {
        return std::pair(triangle(i), i) < std::pair(triangle(j), j);
      });
    Marks& marks = in_contact_[static_cast<std::size_t>(side)];
    marks.restart(surfaces[static_cast<std::size_t>(side)].mesh->triangles.size());
    for (std::size_t begin = 0, end = 0; begin < order_.size(); begin = end) {
      while (end < order_.size() && triangle(order_[end]) == triangle(order_[begin])) ++end;
      marks.add(triangle(order_[begin]));
      find_seeds(side, std::span(order_).subspan(begin, end - begin));
    }
  }
  std::sort(seeds_.begin(), seeds_.end());
}

// The way from a corner to a point of one of the lines of contact: the first line that it meets tells on which side of
// the other surface the corner is. Where it meets several at once, at a joint or at an edge of the other surface that
// lies in the triangle, all must tell the same. A corner on a line is a
// point of the contour; whether the surface beyond it leads in is lost in rounding.
void InnerVertices::find_seeds(int side, std::span<const std::uint32_t> of_one_triangle) {
  const auto s = static_cast<std::size_t>(side);
  const Touch* aim = nullptr;
  for (const std::uint32_t i : of_one_triangle) {
    if (touches_[i].is_parallel()) return;  // there lines are missing
    if (aim == nullptr && touches_[i].has_length()) aim = &touches_[i];
  }
  if (aim == nullptr) return;
  const PlacedSurface& surface = surfaces_[s];
  const Segment line{aim->shared.points[0], aim->shared.points[1]};
  const Vec3 target = line[0] + 0.382 * (line[1] - line[0]);  // no place of symmetry, where joints are likely
  const Vec3 size = abs(aim->normals[s]);
  const int drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto turn = [&](const Vec3& p, const Vec3& q) { return component(cross(p, q), drop); };
  for (const std::uint32_t vertex : surface.mesh->triangles[aim->triangles[s]]) {
    const Vec3 from = surface.local_vertex(vertex), way = target - from;
    double reach = 1;
    std::uint32_t region = aim->region;
    bool is_inside = false, is_outside = false;
    for (const std::uint32_t i : of_one_triangle) {
      const Touch& touch = touches_[i];
      if (is_on(touch.shared, from)) {
        is_inside = false;
        break;
      }
      if (!touch.has_length()) continue;
      const Vec3 start = touch.shared.points[0] - from, along = touch.shared.points[1] - touch.shared.points[0];
      const double across = turn(way, along);
      const double at = &touch == aim ? 1 : turn(start, along) / across, where = turn(start, way) / across;
      const bool is_met = &touch == aim || (at > 0 && where > -kTogether && where < 1 + kTogether);
      if (!is_met || at > reach + kTogether) continue;
      if (at < reach - kTogether) is_inside = is_outside = false;
      if (at < reach) reach = at, region = touch.region;
      const double height = dot(touch.normals[1 - s], from - touch.shared.points[0]);
      is_inside |= height < -kRounding, is_outside |= height >= -kRounding;
    }
    if (is_inside && !is_outside) seeds_.push_back({region, side, vertex});
  }
}

std::span<const Vec3> InnerVertices::patch(std::uint32_t region, int side) {
  const auto s = static_cast<std::size_t>(side);
  const PlacedSurface& surface = surfaces_[s];
  const solid::Topology& topology = *surface.topology;
  std::vector<Vec3>& found = found_[s];
  found.clear(), ahead_.clear();
  const auto first = std::lower_bound(seeds_.begin(), seeds_.end(), Seed{region, side, 0});
  if (first == seeds_.end() || first->region != region || first->side != side) return found;
  seen_.restart(topology.positions);
  const auto see = [&](std::uint32_t vertex) {
    if (!seen_.add(topology.position[vertex])) return;
    found.push_back(surface.local_vertex(vertex));
    ahead_.push_back(topology.position[vertex]);
  };
  for (auto seed = first; seed != seeds_.end() && seed->region == region && seed->side == side; ++seed)
    see(seed->vertex);
  while (!ahead_.empty()) {
    const std::uint32_t at = ahead_.back();
    ahead_.pop_back();
    for (const std::uint32_t triangle : topology.fan(at))
      if (!in_contact_[s].has(triangle))
        for (const std::uint32_t vertex : surface.mesh->triangles[triangle]) see(vertex);
  }
  return found;
}

}  // namespace impinge::clash
