// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "scenes/plant_solids.hpp"

/// Flat machines that turn: parts are outlines between two heights, so that whether two of them overlap is a question
/// about polygons.
namespace impinge::scenes {

/// A part about its own origin, and how it moves: at times[i] it stands at places[i], turned by angles[i]. Between two
/// times both run evenly.
struct FlatPart {
  std::string name;
  Loop outline;  ///< counterclockwise, and its own origin sees all of it
  double low = 0, high = 1;
  std::vector<double> times, angles;
  std::vector<Flat> places;
};

/// A crank that turns once in `seconds`, a coupler and a rocker (Grashof's condition holds), a post that the coupler
/// never reaches, and a stop that the rocker runs into. Crank, rocker and stop lie in one layer, the coupler above.
std::vector<FlatPart> four_bar_linkage(double seconds);

/// Two wheels of 12 and 18 trapezoid teeth, turning evenly, the small one once in `seconds`. They run free at a
/// distance of 7.875 and more; a little nearer, teeth overlap and part again twice a tooth's turn (at 7.859375 for
/// about a hundredth of one of the small wheel's turns), below 7.84 all the time.
std::vector<FlatPart> gear_pair(double seconds, double distance);

/// The angle and the place of a part at a time.
struct FlatPose {
  double angle;
  Flat place;
};
FlatPose at(const FlatPart& part, double seconds);

/// As binary glTF 2.0, with one animation of the nodes' rotation and translation in single precision.
std::string animated_glb(const std::vector<FlatPart>& parts);

}  // namespace impinge::scenes
