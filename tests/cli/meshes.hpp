// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "tests/core/folder.hpp"

/// Small meshes with whole coordinates, as the texts of mesh files.
namespace impinge::test {

struct Solid {
  std::vector<std::array<int, 3>> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// The cube of edge 2 with its lowest corner at (x, y, z), 12 triangles, outward. Opposite faces are cut along parallel
/// diagonals, so flush cubes have the same diagonal.
Solid cube(int x, int y, int z);

/// The same as a box from its lowest corner to its highest.
Solid box(const std::array<int, 3>& lo, const std::array<int, 3>& hi);

/// Two triangles in the plane of height z: a rectangle with four open edges.
Solid sheet(const std::array<int, 2>& lo, const std::array<int, 2>& hi, int z);

/// Several, that need not be connected, as one.
Solid as_one(const std::vector<Solid>& solids);

std::string off(const Solid& solid);
/// Writes each as NAME.off.
void write_off(const Folder& folder, const std::vector<std::pair<std::string, Solid>>& solids);
std::string obj(const Solid& solid);
/// Several parts in one file; only the first may have an empty name, and then has none.
std::string obj(const std::vector<std::pair<std::string, Solid>>& parts);
std::string ply(const Solid& solid);
std::string stl(const Solid& solid);

/// Where a node of a glTF file shows the cube at the origin.
struct Node {
  std::string name;
  std::array<int, 3> shift;
};
/// A glTF file in one text: all nodes show one mesh.
std::string gltf(const std::vector<Node>& nodes);

/// So many triangles with one corner in common, at the origin, turned by `turn`: two of them touch in all pairs, and
/// none can be told from floating-point numbers alone.
std::string off_fan(int triangles, double turn);

}  // namespace impinge::test
