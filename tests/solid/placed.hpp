// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "pipeline/mesh_state.hpp"
#include "solid/body.hpp"
#include "tests/core/support.hpp"

/// Bodies for the tests of `solid/`.
namespace impinge::test {

inline scenes::MeshData tetrahedron(const std::array<Point, 4>& p) {
  scenes::MeshData shape;
  for (const Point& v : p) shape.add_vertex(v.x, v.y, v.z);
  shape.add_triangle(0, 2, 1), shape.add_triangle(0, 1, 3), shape.add_triangle(1, 2, 3), shape.add_triangle(2, 0, 3);
  return shape;
}

}  // namespace impinge::test
