// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "report/assembly.hpp"

/// An assembly as it is drawn: for the eye, not for an answer.
namespace impinge::report {

/// A mesh in single precision, about its own middle.
struct DrawnMesh {
  std::vector<float> xyz;                ///< 3 coordinates a vertex
  std::vector<std::uint32_t> triangles;  ///< 3 vertices a triangle
};

struct DrawnObject {
  std::optional<std::uint32_t> mesh;     ///< nothing: the object has no triangles
  Pose pose;                             ///< from the drawn mesh's coordinates to the world
  std::optional<std::uint32_t> group{};  ///< of the scene's, that it stands under in the tree of parts
};

struct DrawnScene {
  std::vector<DrawnMesh> meshes;     ///< each once, however many objects show it
  std::vector<Point> middles;        ///< of the meshes: what was their origin is at -middle
  std::vector<DrawnObject> objects;  ///< those of the assembly
  std::vector<io::Group> groups;     ///< those of the assembly that have a name; what is in others is in theirs
  std::uint64_t triangles = 0;       ///< of all objects as they are
  std::uint64_t shown = 0;           ///< and as they are drawn: fewer if meshes were simplified
  std::uint64_t asked = 0;           ///< how many were to be drawn at most
};

/// The map of a mesh that was moved so that `middle` became its origin.
Affine about(const Point& middle, const Affine& map);

/// With about `most_triangles` over all objects, where that takes simplifying; with more where parts would lose
/// their shape. Errors: `cancelled`.
Result<DrawnScene> draw(const Assembly& assembly, std::uint64_t most_triangles, const std::stop_token& stop);

}  // namespace impinge::report
