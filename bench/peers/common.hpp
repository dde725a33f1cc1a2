// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/mesh.hpp"
#include "scenes/scene.hpp"

/// Vertices, poses and pairs for the peers. They are linked apart from impinge, so the formulas stand here once more.
namespace impinge::bench {

/// The formula of `Pose`: the numbers that every answer is held against.
inline Point placed(const Pose& pose, const Point& p) {
  const auto row = [&](std::size_t i) {
    return ((pose.R[3 * i] * p.x + pose.R[3 * i + 1] * p.y) + pose.R[3 * i + 2] * p.z) + pose.t[i];
  };
  return {row(0), row(1), row(2)};
}

inline std::vector<Point> placed(const scenes::MeshData& data, const Pose& pose) {
  std::vector<Point> points;
  points.reserve(data.vertex_count());
  for (std::size_t i = 0; i < data.xyz.size(); i += 3)
    points.push_back(placed(pose, {data.xyz[i], data.xyz[i + 1], data.xyz[i + 2]}));
  return points;
}

/// Where `b` stands in the frame of `a`, rounded.
inline Pose relative(const Pose& a, const Pose& b) {
  Pose result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      result.R[3 * i + j] = a.R[i] * b.R[j] + a.R[3 + i] * b.R[3 + j] + a.R[6 + i] * b.R[6 + j];
    result.t[i] = a.R[i] * (b.t[0] - a.t[0]) + a.R[3 + i] * (b.t[1] - a.t[1]) + a.R[6 + i] * (b.t[2] - a.t[2]);
  }
  return result;
}

/// A pose as RAPID takes it, which does not promise to leave it as it is.
struct RowsAndPlace {
  explicit RowsAndPlace(const Pose& pose) {
    std::copy(pose.R.begin(), pose.R.end(), &rows[0][0]);
    std::copy(pose.t.begin(), pose.t.end(), place);
  }
  double rows[3][3], place[3];
};

/// In the order of `Contacts`.
inline std::vector<TrianglePair> sorted(std::vector<TrianglePair> pairs) {
  std::sort(pairs.begin(), pairs.end(),
            [](const TrianglePair& p, const TrianglePair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
  return pairs;
}

}  // namespace impinge::bench
