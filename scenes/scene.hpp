// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "impinge/mesh.hpp"

/// Meshes and placed scenes made from numbers alone, the same on every machine whose libm rounds alike.
namespace impinge::scenes {

/// What `Mesh::create` takes.
struct MeshData {
  std::vector<double> xyz;               ///< 3 a vertex
  std::vector<std::uint32_t> triangles;  ///< 3 indices a triangle

  [[nodiscard]] std::size_t vertex_count() const { return xyz.size() / 3; }
  [[nodiscard]] std::size_t triangle_count() const { return triangles.size() / 3; }
  /// Returns the new vertex's index.
  std::uint32_t add_vertex(double x, double y, double z);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  /// A triangle with three vertices of its own.
  void add_triangle(const std::array<double, 9>& corners);
};

struct PlacedObject {
  std::uint32_t mesh;  ///< index into `PlacedScene::meshes`
  Pose pose{};
  std::uint32_t group = 0;  ///< as in `Scene::add`
};

struct PlacedScene {
  std::vector<MeshData> meshes;
  std::vector<PlacedObject> objects;
};

/// Two objects, each with its own mesh and the identity pose.
PlacedScene pair_scene(MeshData a, MeshData b);

}  // namespace impinge::scenes
