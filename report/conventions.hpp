// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "impinge/mesh.hpp"
#include "impinge/report.hpp"

/// What other tools take coordinates for, and the way there from the files' coordinates.
namespace impinge::report {

struct Conventions {
  double metres = 1;      ///< that one of the files' units has
  bool y_up = false;      ///< or Z
  bool is_known = false;  ///< the unit: the call says it, or a file does
};

/// Whether a file has Y up when it is read, or else Z: by its format's rules, or because assimp's reader turns it so.
/// Nothing where there are no rules, and programs write either.
std::optional<bool> has_y_up(const std::string& file);

/// Which axis is up, Y or Z, in the coordinates of all files as they are read: as the call says, or else as the first
/// file has it whose format or reader leaves no choice: Z in IFC, 3MF and Blender's, Y in others that assimp reads,
/// which turns most of them so. OBJ, OFF, PLY, STL and AMF leave it open; where there is nothing else, it is Z.
bool is_y_up(const std::vector<std::string>& files, std::optional<bool> said);

/// The assembly's unit, or else metres; and up as above.
Conventions conventions_of(const ReportOptions& options, const Assembly& assembly);

/// In metres with Z up, as BCF has it; and a direction likewise.
Point place_in_bcf(const Conventions& conventions, const Point& point);
Point direction_in_bcf(const Conventions& conventions, const Point& direction);

/// The matrix to metres with Y up, as glTF has it, column by column.
std::array<double, 16> matrix_to_gltf(const Conventions& conventions);

}  // namespace impinge::report
