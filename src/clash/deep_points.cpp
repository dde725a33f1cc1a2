// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/deep_points.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/local_frame.hpp"
#include "measure/nearest.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

struct Shell {
  std::vector<std::uint32_t> triangles;
  Box box;
};

std::vector<Shell> shells_of(const solid::Part& part) {
  std::vector<Shell> shells(part.topology.shells,
                            {{}, {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}}});
  for (std::uint32_t t = 0; t < part.body.size(); ++t) {
    if (!part.is_boundary(t)) continue;
    Shell& shell = shells[part.topology.shell[t]];
    const Box box = box_of(part.body.triangle(t));
    shell.triangles.push_back(t);
    shell.box = {min(shell.box.lo, box.lo), max(shell.box.hi, box.hi)};
  }
  return shells;
}

double area_of(const Triangle& t) { return norm(cross(t[1] - t[0], t[2] - t[0])) / 2; }

/// The deepest of some points on the inward normal from a triangle's centroid.
std::optional<DeepPoint> deepest_below(const solid::Part& part, std::uint32_t t, const LocalFrame& frame, double size) {
  constexpr int kTries = 10;
  const Triangle triangle = part.body.triangle(t), local = frame.to_local(triangle);
  const Vec3 normal = cross(local[1] - local[0], local[2] - local[0]);
  const double length = norm(normal);
  if (!(length > 0)) return std::nullopt;
  const std::uint32_t shell = part.topology.shell[t];
  const Vec3 inward = (part.sides[shell].front ? 1 : -1) / length * normal;
  const Vec3 middle = (1.0 / 3) * triangle[0] + (1.0 / 3) * triangle[1] + (1.0 / 3) * triangle[2];
  std::optional<DeepPoint> best;
  double step = size / 2;
  for (int i = 0; i < kTries && (!best || step > best->depth); ++i, step /= 2) {
    const Vec3 point = middle + step * inward;
    const auto nearest = measure::nearest_point(part.body.placed, point, step * (1 + 0x1p-20));
    if (!nearest || part.topology.shell[nearest->triangle] != shell) continue;
    const double depth = nearest->distance - nearest->error;
    if (depth > (best ? best->depth : 0) && solid::winding_number(part.body.placed, point).value_or(0) != 0)
      best = DeepPoint{point, depth, shell};
  }
  return best;
}

}  // namespace

std::vector<DeepPoint> deep_points(const solid::Part& part, double enough) {
  constexpr std::size_t kMostPoints = 3, kMostTriangles = 24;
  std::vector<DeepPoint> points;
  if (!part.solid) return points;
  for (Shell& shell : shells_of(part)) {
    if (shell.triangles.empty()) continue;
    const LocalFrame frame = local_frame(shell.box, shell.box);
    const double size = norm(frame.unit * (shell.box.hi - shell.box.lo)) / frame.unit;
    // The largest triangles come first: below a sliver another face is near.
    std::vector<std::pair<double, std::uint32_t>> order;
    for (const std::uint32_t t : shell.triangles)
      order.emplace_back(-area_of(frame.to_local(part.body.triangle(t))), t);
    const std::size_t count = std::min(order.size(), kMostTriangles);
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
    std::vector<DeepPoint> found;
    std::size_t deep = 0;
    for (std::size_t i = 0; i < count && deep < kMostPoints; ++i) {
      const auto point = deepest_below(part, order[i].second, frame, size);
      if (!point) continue;
      found.push_back(*point);
      deep += point->depth > enough ? 1U : 0U;
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const DeepPoint& p, const DeepPoint& q) { return p.depth > q.depth; });
    found.resize(std::min(found.size(), kMostPoints));
    points.insert(points.end(), found.begin(), found.end());
  }
  return points;
}

}  // namespace impinge::clash
