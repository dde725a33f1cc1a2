// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "impinge/clash.hpp"

/// What is said of a part: what it is, and where it is open or meets itself.
namespace impinge::report {

struct Part {
  PartFacts facts;
  std::optional<Point> crossing_near;  ///< where the first self-crossing is: a point near both triangles
  double size = 0;                     ///< radius of its bounding sphere
};

/// The facts that the library found, with places. `facts` must be those of this placed mesh.
Part describe(const PartFacts& facts, const Mesh& mesh, const Pose& pose);

/// What a plain solid has not: "12 open edges, first at (0 0 1)-(1 0 1) mm; at 2 of them inside cannot be told
/// from outside, first at (0 0 1)-(1 0 2) mm; 2 self-crossings, first near (0.5 0 0) mm; 1 triangle turned". Places are
/// in the unit, whose name comes behind them, "" where it is not known.
std::string facts_text(const Part& part, std::string_view unit = {});

/// A coordinate to a ten-thousandth of the object's size: the rest is noise to the eye.
std::string coordinate(double value, double size);

}  // namespace impinge::report
