// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "core/vec3.hpp"
#include "impinge/regions.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge::test {

inline std::vector<Region> regions_between(const scenes::MeshData& a, const scenes::MeshData& b,
                                           const Pose& pose_a = {}, const Pose& pose_b = {}, int threads = 0) {
  auto regions = contact_regions(mesh_of(a), pose_a, mesh_of(b), pose_b, {.threads = threads});
  EXPECT_TRUE(regions) << regions.error().message;
  return regions ? std::move(*regions) : std::vector<Region>{};
}

/// The one region that there is to be.
inline Region region_between(const scenes::MeshData& a, const scenes::MeshData& b, const Pose& pose_a = {},
                             const Pose& pose_b = {}) {
  std::vector<Region> regions = regions_between(a, b, pose_a, pose_b);
  EXPECT_EQ(regions.size(), 1u);
  return regions.empty() ? Region{} : std::move(regions[0]);
}

inline void expect_near(const Point& found, const Point& expected, double off = 1e-12) {
  EXPECT_NEAR(found.x, expected.x, off);
  EXPECT_NEAR(found.y, expected.y, off);
  EXPECT_NEAR(found.z, expected.z, off);
}

inline bool is_closed(const std::vector<Point>& line) { return line.size() > 3 && line.front() == line.back(); }

/// Closed, convex: the hull of a polygon in one plane and an apex, or of a polygon and its copy moved by `up`.
inline scenes::MeshData cone(const std::vector<Point>& base, const Point& apex) {
  scenes::MeshData mesh;
  for (const Point& p : base) mesh.add_vertex(p.x, p.y, p.z);
  const std::uint32_t top = mesh.add_vertex(apex.x, apex.y, apex.z);
  const auto n = static_cast<std::uint32_t>(base.size());
  for (std::uint32_t i = 0; i < n; ++i) mesh.add_triangle(i, (i + 1) % n, top);
  for (std::uint32_t i = 2; i < n; ++i) mesh.add_triangle(0, i, i - 1);
  return mesh;
}
inline scenes::MeshData prism(const std::vector<Point>& base, const Point& up) {
  scenes::MeshData mesh;
  for (const Point& p : base) mesh.add_vertex(p.x, p.y, p.z);
  for (const Point& p : base) mesh.add_vertex(p.x + up.x, p.y + up.y, p.z + up.z);
  const auto n = static_cast<std::uint32_t>(base.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.add_triangle(i, j, n + j);
    mesh.add_triangle(i, n + j, n + i);
  }
  for (std::uint32_t i = 2; i < n; ++i) {
    mesh.add_triangle(0, i, i - 1);
    mesh.add_triangle(n, n + i - 1, n + i);
  }
  return mesh;
}

}  // namespace impinge::test
