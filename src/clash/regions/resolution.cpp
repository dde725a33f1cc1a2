// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/resolution.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "clash/local_frame.hpp"
#include "clash/slab.hpp"

namespace impinge::clash {
namespace {

/// The radius of the circle within: 2 area / perimeter, as the wall of a solid is 2 volume / area.
double width(const Triangle& t) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const double perimeter = norm(u) + norm(v) + norm(t[2] - t[1]);
  return perimeter > 0 ? norm(cross(u, v)) / perimeter : 0;
}

/// The one in the middle: a few slivers say nothing of the others.
double median_width(const solid::Body& body, std::vector<std::uint32_t> triangles, const LocalFrame& frame) {
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  std::vector<double> widths;
  widths.reserve(triangles.size());
  for (const std::uint32_t t : triangles) widths.push_back(width(frame.to_local(body.triangle(t))));
  if (widths.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return *middle;
}

}  // namespace

Reach reach_of(const Side& a, const Side& b, std::span<const exact::Contact> contacts, double tolerance) {
  if (tolerance == 0) return {};
  const LocalFrame frame = local_frame(a.body.box, b.body.box);
  std::vector<std::uint32_t> of_a, of_b;
  for (const exact::Contact& pair : contacts) of_a.push_back(pair.a), of_b.push_back(pair.b);
  const double width =
      std::min(median_width(a.body, std::move(of_a), frame), median_width(b.body, std::move(of_b), frame));
  // No finer than rounding, however narrow they are.
  const double least = std::max(0x1p-8 * tolerance, kLeastTolerance * frame.scale / frame.unit);
  return {tolerance, std::min(tolerance, std::max(width / (4 * frame.unit), least))};
}

}  // namespace impinge::clash
