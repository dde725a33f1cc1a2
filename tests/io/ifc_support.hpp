// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <map>

#include "scenes/step.hpp"
#include "support.hpp"

namespace impinge::io {

inline Points world_points(const Object& object) {
  Points points;
  for (const Point& p : object.mesh.vertices()) {
    const auto row = [&](int r) {
      return object.pose.R[3 * r] * p.x + object.pose.R[3 * r + 1] * p.y + object.pose.R[3 * r + 2] * p.z +
             object.pose.t[r];
    };
    points.push_back({row(0), row(1), row(2)});
  }
  return points;
}

/// By the divergence theorem, about the first vertex.
inline double volume_of(const Object& object) {
  const auto points = points_of(object);
  double six = 0;
  for (const auto& [a, b, c] : triangles_of(object)) {
    const Point o = points[0];
    const auto from = [&](std::uint32_t i) { return Point{points[i].x - o.x, points[i].y - o.y, points[i].z - o.z}; };
    const Point p = from(a), q = from(b), r = from(c);
    six += p.x * (q.y * r.z - q.z * r.y) - p.y * (q.x * r.z - q.z * r.x) + p.z * (q.x * r.y - q.y * r.x);
  }
  return six / 6;
}

/// Whether as many triangles run along each edge one way as the other.
inline bool is_closed(const Object& object) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
  for (const auto& t : triangles_of(object))
    for (int k = 0; k < 3; ++k) ++ways[{t[k], t[(k + 1) % 3]}], --ways[{t[(k + 1) % 3], t[k]}];
  return std::all_of(ways.begin(), ways.end(), [](const auto& way) { return way.second == 0; });
}

struct Box {
  Point low, high;
};
inline Box box_of(const Object& object) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Point& p : world_points(object)) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

inline void expect_box(const Object& object, const Box& expected, double error) {
  const Box box = box_of(object);
  EXPECT_NEAR(box.low.x, expected.low.x, error) << object.name;
  EXPECT_NEAR(box.low.y, expected.low.y, error) << object.name;
  EXPECT_NEAR(box.low.z, expected.low.z, error) << object.name;
  EXPECT_NEAR(box.high.x, expected.high.x, error) << object.name;
  EXPECT_NEAR(box.high.y, expected.high.y, error) << object.name;
  EXPECT_NEAR(box.high.z, expected.high.z, error) << object.name;
}

inline Model read_ifc(const scenes::Step& step) { return read_text(step.text(), "case.ifc"); }

}  // namespace impinge::io
