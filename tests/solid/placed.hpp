// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "pipeline/mesh_state.hpp"
#include "solid/body.hpp"
#include "tests/core/support.hpp"

/// Bodies for the tests of `solid/`.
namespace impinge::test {

/// Kept alive by the handle.
inline hierarchy::PlacedTree placed(const Mesh& mesh, const Pose& pose = {}) {
  return {&mesh.state().data, &mesh.state().wide_tree, pose};
}

/// All shapes' vertices and triangles as one mesh.
inline scenes::MeshData joined(std::initializer_list<scenes::MeshData> shapes) {
  scenes::MeshData whole;
  for (const scenes::MeshData& shape : shapes) {
    const auto first = static_cast<std::uint32_t>(whole.xyz.size() / 3);
    whole.xyz.insert(whole.xyz.end(), shape.xyz.begin(), shape.xyz.end());
    for (const std::uint32_t i : shape.triangles) whole.triangles.push_back(first + i);
  }
  return whole;
}

inline scenes::MeshData inverted(scenes::MeshData shape) {
  for (std::size_t i = 0; i < shape.triangles.size(); i += 3) std::swap(shape.triangles[i + 1], shape.triangles[i + 2]);
  return shape;
}

inline scenes::MeshData tetrahedron(const std::array<Point, 4>& p) {
  scenes::MeshData shape;
  for (const Point& v : p) shape.add_vertex(v.x, v.y, v.z);
  shape.add_triangle(0, 2, 1), shape.add_triangle(0, 1, 3), shape.add_triangle(1, 2, 3), shape.add_triangle(2, 0, 3);
  return shape;
}

}  // namespace impinge::test
