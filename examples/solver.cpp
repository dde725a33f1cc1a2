// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Regions and normals for a solver: where two parts are in contact, region by region, and which way to push them apart.
//
// A bench of one mesh stands on a floor on two feet: one of 2 x 1 from x = 3 to 5, one of 1 x 1 from x = 0 to 1. The
// largest region comes first, and the normal says how the bench must go to leave the floor: up.
//
// prints: area 2 about (4.0, 0.5, 0.0), from (3, 0) to (5, 1), normal (0, 0, 1)
// prints: area 1 about (0.5, 0.5, 0.0), from (0, 0) to (1, 1), normal (0, 0, 1)
#include <cstdio>

#include "shapes.hpp"

int main() {
  std::vector<double> xyz;
  std::vector<std::uint32_t> triangles;
  for (const auto& foot : {box({0, 0, 0}, {1, 1, 2}), box({3, 0, 0}, {5, 1, 2})}) {
    const auto first = static_cast<std::uint32_t>(xyz.size() / 3);
    for (const auto& p : foot.vertices()) xyz.insert(xyz.end(), {p.x, p.y, p.z});
    for (const auto& [i, j, k] : foot.triangles()) triangles.insert(triangles.end(), {first + i, first + j, first + k});
  }
  const auto bench = value_of(impinge::Mesh::create(xyz, triangles));
  const auto floor = box({-2, -2, -1}, {8, 4, 0});

  for (const impinge::Region& region : value_of(impinge::contact_regions(floor, {}, bench, {}))) {
    const auto& [low, high] = region.box;
    const auto &c = region.centroid, &n = region.normal;
    std::printf("area %g about (%.1f, %.1f, %.1f), from (%g, %g) to (%g, %g), normal (%g, %g, %g)\n", region.area, c.x,
                c.y, c.z, low.x, low.y, high.x, high.y, n.x, n.y, n.z);
  }
}
