// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Two meshes: every pair of their triangles that touch, with its kind (examples/CMakeLists.txt derives the numbers).
//
// prints: 64 pairs of triangles touch, 16 of them coplanar
#include <cstdint>
#include <iostream>
#include <vector>

#include "impinge/impinge.hpp"

int main() {
  const std::vector<double> corners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,   // below, counter-clockwise
                                    0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};  // above
  const std::vector<std::uint32_t> triangles{0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                             1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
  const auto cube = impinge::Mesh::create(corners, triangles);
  if (!cube) {
    std::cerr << cube.error().message << '\n';
    return 1;
  }

  const impinge::Pose here;                 // the identity
  const impinge::Pose beside{.t{1, 0, 0}};  // face against face
  const auto contacts = impinge::collide(*cube, here, *cube, beside);
  if (!contacts) {
    std::cerr << contacts.error().message << '\n';
    return 1;
  }

  int coplanar = 0;
  for (const auto kind : contacts->kinds) coplanar += kind == impinge::Kind::coplanar;
  std::cout << contacts->triangles.size() << " pairs of triangles touch, " << coplanar << " of them coplanar\n";
}
