// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/surface_reach.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "clash/point_grid.hpp"
#include "core/local_frame.hpp"
#include "exact/triangle_pair.hpp"
#include "measure/nearest.hpp"

namespace impinge::clash {
namespace {

/// The lesser of the heights of a triangle above and below a plane. Floating point suffices: they are known to cross.
double least_height(const Triangle& triangle, const Triangle& plane) {
  const Vec3 normal = cross(plane[1] - plane[0], plane[2] - plane[0]);
  const double length = norm(normal);
  if (!(length > 0)) return 0;
  double above = 0, below = 0;
  for (const Vec3& vertex : triangle) {
    const double height = dot(normal, vertex - plane[0]) / length;
    above = std::max(above, height), below = std::max(below, -height);
  }
  return std::min(above, below);
}

/// Whether each triangle of one has one of the other with the same corners, in whatever order.
bool are_same(const solid::Body& a, const solid::Body& b, double tolerance) {
  if (a.size() != b.size() || a.size() == 0) return false;
  PointGrid grid(std::max(tolerance, 0x1p-1000));
  std::vector<std::uint32_t> number_a(a.world.size()), number_b(b.world.size());
  std::uint32_t points = 0;
  const auto number = [&](const Vec3& point) {
    std::uint32_t found = points;
    grid.find(point, [&](const Vec3&, std::uint32_t known) {
      found = known;
      return true;
    });
    if (found == points) grid.add(point, points++);
    return found;
  };
  using Corners = std::array<std::uint32_t, 3>;
  const auto corners_of = [&](const solid::Body& body) {
    std::vector<std::uint32_t> numbers;
    for (const Vec3& vertex : body.world) numbers.push_back(number(vertex));
    std::vector<Corners> triangles;
    for (const auto& [p, q, r] : body.placed.mesh->triangles) {
      Corners corners{numbers[p], numbers[q], numbers[r]};
      std::sort(corners.begin(), corners.end());
      triangles.push_back(corners);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  };
  const auto of_a = corners_of(a);
  return of_a == corners_of(b);
}

}  // namespace

double surface_reach(const solid::Body& a, const solid::Body& b, const std::stop_token& stop) {
  const LocalFrame frame = local_frame(a.box, b.box);
  const double largest = std::max(largest_coordinate(a.box), largest_coordinate(b.box));
  const Vec3 off = max(abs(a.box.lo - b.box.lo), abs(a.box.hi - b.box.hi));
  if (max_component(off) <= 0x1p-42 * largest && are_same(a, b, 0x1p-42 * largest)) return kInfinity;
  double reach = 0;
  const auto take = [&](const TrianglePair& pair) {
    const Triangle of_a = a.triangle(pair.a), of_b = b.triangle(pair.b);
    const Triangle local_a = frame.to_local(of_a), local_b = frame.to_local(of_b);
    const double height = std::min(least_height(local_a, local_b), least_height(local_b, local_a)) / frame.unit;
    if (height > reach && exact::classify(of_a, of_b) == Kind::crossing) reach = height;
    return true;
  };
  measure::candidate_pairs(a.placed, b.placed, 0, take, stop);
  return reach;
}

}  // namespace impinge::clash
