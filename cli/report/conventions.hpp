// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "arguments.hpp"
#include "impinge/mesh.hpp"

/// What other tools take coordinates for, and the way there from the files' coordinates.
namespace impinge::cli {

struct Conventions {
  double metres = 1;      ///< that one of the files' units has
  bool y_up = false;      ///< or Z
  bool is_known = false;  ///< the unit: the call says it, or all files have metres as they are read
};

/// As the call says, or else: metres, and the upward axis that the first file's format mostly has: Z in OBJ, OFF, PLY,
/// STL and 3MF, Y in all others that assimp reads, which turns most of them so.
Conventions conventions_of(const ClashArguments& arguments);

/// In metres with Z up, as BCF has it; and a direction likewise.
Point place_in_bcf(const Conventions& conventions, const Point& point);
Point direction_in_bcf(const Conventions& conventions, const Point& direction);

/// The matrix to metres with Y up, as glTF has it, column by column.
std::array<double, 16> matrix_to_gltf(const Conventions& conventions);

}  // namespace impinge::cli
