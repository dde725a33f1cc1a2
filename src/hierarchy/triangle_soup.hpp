// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "core/mesh_data.hpp"

namespace impinge::hierarchy {

/// A triangle as the splits see it: everything in one place and in single precision, so that a pass over triangles
/// streams. Corner coordinates are 2^-k v - base; a stored one is within (2^-24 + 2^-52) of itself, and 2^-149, of the
/// exact one, for the difference is rounded once to double and once to float.
struct SoupTriangle {
  float corner[9];  ///< x, y, z of the first corner, then of the second and the third
  std::uint32_t id;
};

/// Where soup triangles take their numbers from. `unit` is 2^-k.
struct SoupSource {
  const MeshData& mesh;
  double unit;

  [[nodiscard]] Vec3 corner(std::uint32_t triangle, std::size_t i) const { return vertex(mesh.triangles[triangle][i]); }
  [[nodiscard]] Vec3 vertex(std::uint32_t i) const { return unit * mesh.vertices[i]; }
};

/// A point amid the triangles, where most of them are: what is near the base is stored precisely, however far away a
/// few others lie. `id_of` gives the id of each of `count` triangles.
Vec3 choose_base(const SoupSource& source, std::size_t count, const std::function<std::uint32_t(std::size_t)>& id_of);

/// Writes the corners; the ids are there.
void write_corners(const SoupSource& source, const Vec3& base, std::span<SoupTriangle> triangles);

}  // namespace impinge::hierarchy
