// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/self/self_crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "clash/vertex_contact.hpp"
#include "clash/wall.hpp"
#include "core/local_frame.hpp"
#include "exact/triangle_pair.hpp"

namespace impinge::clash {
namespace {

/// The normal of a triangle's plane and the heights of another triangle's vertices over it. Floating point suffices:
/// the triangles are known to cross, and only the size of the crossing is asked for.
struct Heights {
  Vec3 normal;
  std::array<double, 3> height;

  Heights(const Triangle& plane, const Triangle& other) : normal(cross(plane[1] - plane[0], plane[2] - plane[0])) {
    const double length = norm(normal);
    if (length > 0) normal = (1 / length) * normal;
    for (std::size_t i = 0; i < 3; ++i) height[i] = dot(normal, other[i] - plane[0]);
  }
  /// How far the other triangle reaches through the plane, on the side where that is less.
  [[nodiscard]] double depth() const {
    const auto [lo, hi] = std::minmax_element(height.begin(), height.end());
    return std::max(0.0, std::min(-*lo, *hi));
  }
  /// The interval, along a line, in which the other triangle meets the plane.
  [[nodiscard]] std::pair<double, double> span(const Triangle& other, const Vec3& origin, const Vec3& along) const {
    double lo = 1, hi = -1;
    bool is_empty = true;
    const auto take = [&](const Vec3& point) {
      const double at = dot(along, point - origin);
      lo = is_empty ? at : std::min(lo, at), hi = is_empty ? at : std::max(hi, at);
      is_empty = false;
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (height[i] == 0) take(other[i]);
      if ((height[i] < 0) == (height[j] < 0) || height[i] == 0 || height[j] == 0) continue;
      take(other[i] + (height[i] / (height[i] - height[j])) * (other[j] - other[i]));
    }
    return {lo, hi};
  }
};

/// The approximate length of the segment that two crossing triangles share.
double shared_length(const Triangle& a, const Triangle& b, const Heights& a_over_b, const Heights& b_over_a) {
  const Vec3 line = cross(a_over_b.normal, b_over_a.normal);
  const double sine = norm(line);
  if (sine == 0) return norm(a[1] - a[0]);
  const Vec3 along = (1 / sine) * line;
  const auto [lo_a, hi_a] = a_over_b.span(a, a[0], along);
  const auto [lo_b, hi_b] = b_over_a.span(b, a[0], along);
  return std::min(hi_a, hi_b) - std::max(lo_a, lo_b);
}

}  // namespace

bool is_defect(const Triangle& a, const Triangle& b, Kind kind, double tolerance) {
  // Most triangles around a vertex share only that vertex, which is quicker to test.
  if (kind == Kind::coplanar) return !find_vertex_contact(a, b, 0) && exact::share_area(a, b);
  if (kind != Kind::crossing) return false;
  if (tolerance == 0) return true;
  const Heights a_over_b(b, a), b_over_a(a, b);
  return a_over_b.depth() > tolerance && b_over_a.depth() > tolerance &&
         shared_length(a, b, a_over_b, b_over_a) > tolerance;
}

double defect_tolerance(const solid::Body& body, const solid::Topology& topology, double tolerance) {
  if (!topology.closed) return tolerance;
  const LocalFrame frame = local_frame(body.box, body.box);
  AreaAndVolume whole;
  std::vector<AreaAndVolume> shells(topology.shells);
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    if (!topology.is_proper(t)) continue;
    const Triangle triangle = frame.to_local(body.triangle(t));
    whole.add(triangle), shells[topology.shell[t]].add(triangle);
  }
  whole.volume = 0;
  for (const AreaAndVolume& shell : shells) whole.volume += std::abs(shell.volume);
  return whole.area > 0 ? std::min(tolerance, whole.wall() / 4 / frame.unit) : tolerance;
}

}  // namespace impinge::clash
