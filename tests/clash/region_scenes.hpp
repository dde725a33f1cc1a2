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

}  // namespace impinge::test
