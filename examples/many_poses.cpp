// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Many poses: `collide_poses` answers for a whole series in one call, a row for each pose, touching or not.
//
// A spike (a tetrahedron that stands on its point) sinks through a plate of one triangle. By hand: at height 0 its
// point alone lies in the plate, a corner of three faces. At -0.5 the plate cuts those three faces. At -1 the fourth
// face lies in the plate's plane, and an edge of each other one. At 0.5 and -2 the plate passes below and above it.
//
// prints: height  0.5: 0 crossing, 0 touching, 0 coplanar
// prints: height  0.0: 0 crossing, 3 touching, 0 coplanar
// prints: height -0.5: 3 crossing, 0 touching, 0 coplanar
// prints: height -1.0: 0 crossing, 3 touching, 1 coplanar
// prints: height -2.0: 0 crossing, 0 touching, 0 coplanar
#include <array>
#include <cstdio>

#include "shapes.hpp"

int main() {
  const std::vector<double> plate_corners{-4, -4, 0, 4, -4, 0, 0, 4, 0};
  const std::vector<double> spike_corners{0, 0, 0, 0.5, 0, 1, 0, 0.5, 1, -0.5, -0.5, 1};
  const std::vector<std::uint32_t> plate_triangles{0, 1, 2}, spike_triangles{0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3};
  const auto plate = value_of(impinge::Mesh::create(plate_corners, plate_triangles));
  const auto spike = value_of(impinge::Mesh::create(spike_corners, spike_triangles));

  std::vector<impinge::Pose> poses;
  for (const double height : {0.5, 0.0, -0.5, -1.0, -2.0}) poses.push_back({.t{0, 0, height}});
  const std::vector<impinge::Pose> here(1);  // one pose of the plate goes with all of the spike's
  const auto contacts = value_of(impinge::collide_poses(plate, here, spike, poses));

  for (std::size_t row = 0; row < poses.size(); ++row) {
    std::array<int, 3> counts{};
    for (auto i = contacts.offsets[row]; i < contacts.offsets[row + 1]; ++i) ++counts[std::size_t(contacts.kinds[i])];
    std::printf("height %4.1f: %d crossing, %d touching, %d coplanar\n", poses[row].t[2], counts[0], counts[1],
                counts[2]);
  }
}
