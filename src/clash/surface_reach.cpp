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
#include "impinge/measures.hpp"
#include "measure/nearest.hpp"

namespace impinge::clash {
namespace {

/// The normal of a triangle's plane, and the heights of another triangle's vertices over it. Floating point suffices:
/// the two are known to cross.
struct OverPlane {
  Vec3 normal;
  std::array<double, 3> height;

  OverPlane(const Triangle& plane, const Triangle& other) : normal(cross(plane[1] - plane[0], plane[2] - plane[0])) {
    const double length = norm(normal);
    if (length > 0) normal = (1 / length) * normal;
    for (std::size_t i = 0; i < 3; ++i) height[i] = dot(normal, other[i] - plane[0]);
  }
  /// The lesser of those above and below.
  [[nodiscard]] double least() const {
    const auto [lo, hi] = std::minmax_element(height.begin(), height.end());
    return std::max(0.0, std::min(-*lo, *hi));
  }
  /// The interval, along a line in both planes, in which the other triangle meets the plane.
  [[nodiscard]] Interval span(const Triangle& other, const Vec3& along) const {
    Interval found{kInfinity, -kInfinity};
    const auto take = [&](const Vec3& point) {
      const double at = dot(along, point);
      found = {std::min(found.lo, at), std::max(found.hi, at)};
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (height[i] == 0) take(other[i]);
      if (height[i] * height[j] < 0) take(other[i] + (height[i] / (height[i] - height[j])) * (other[j] - other[i]));
    }
    return found;
  }
};

/// The least of the four heights that two triangles have on both sides of each other's planes, and of the length of the
/// segment that they share.
double reach_of(const Triangle& a, const Triangle& b) {
  const OverPlane a_over_b(b, a), b_over_a(a, b);
  const Vec3 line = cross(a_over_b.normal, b_over_a.normal);
  const double sine = norm(line);
  if (!(sine > 0)) return 0;
  const Vec3 along = (1 / sine) * line;
  const Interval of_a = a_over_b.span(a, along), of_b = b_over_a.span(b, along);
  const double length = std::min(of_a.hi, of_b.hi) - std::max(of_a.lo, of_b.lo);
  return std::max(0.0, std::min({a_over_b.least(), b_over_a.least(), length}));
}

}  // namespace

bool are_same(const solid::Body& a, const solid::Body& b, bool any_way, const std::stop_token& stop) {
  if (a.size() != b.size() || a.size() == 0) return false;
  const double tolerance = 0x1p-42 * std::max(largest_coordinate(a.box), largest_coordinate(b.box));
  if (max_component(max(abs(a.box.lo - b.box.lo), abs(a.box.hi - b.box.hi))) > tolerance) return false;
  PointGrid grid(std::max(tolerance, 0x1p-1000));
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
  const auto corners_of = [&](const solid::Body& body, bool turned) {
    std::vector<std::uint32_t> numbers;
    std::vector<Corners> triangles;
    for (const Vec3& vertex : body.world) {
      if (stop.stop_requested()) return triangles;
      numbers.push_back(number(vertex));
    }
    for (const auto& [p, q, r] : body.placed.mesh->triangles) {
      Corners corners{numbers[p], numbers[turned ? r : q], numbers[turned ? q : r]};
      if (any_way)
        std::sort(corners.begin(), corners.end());
      else
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      triangles.push_back(corners);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  };
  const auto of_a = corners_of(a, false);
  return of_a == corners_of(b, false) || (!any_way && of_a == corners_of(b, true));
}

double surface_reach(const solid::Body& a, const solid::Body& b, const std::stop_token& stop) {
  const LocalFrame frame = local_frame(a.box, b.box);
  if (are_same(a, b, true, stop)) return kInfinity;
  double reach = 0;
  const auto take = [&](const TrianglePair& pair) {
    const Triangle of_a = a.triangle(pair.a), of_b = b.triangle(pair.b);
    const double found = reach_of(frame.to_local(of_a), frame.to_local(of_b)) / frame.unit;
    if (found > reach && exact::classify(of_a, of_b) == Kind::crossing) reach = found;
    return true;
  };
  measure::candidate_pairs(a.placed, b.placed, 0, take, stop);
  return reach;
}

}  // namespace impinge::clash
