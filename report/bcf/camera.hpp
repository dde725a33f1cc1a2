// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "report/place.hpp"

namespace impinge::report {

/// From where a picture is taken. Vectors are of length 1 and at right angles.
struct View {
  Point eye{}, right{}, up{}, forward{};
  double distance = 1;  ///< of what is looked at
};

/// From top to bottom, in degrees: BCF 2.1 allows 45 to 60.
constexpr double kFieldOfView = 60;

/// Ways to look at a clash of two parts of these radii, so that it fills a good part of the picture and enough is seen
/// around it: from eight sides, those from above first.
std::array<View, 8> views_of(const Place& place, std::array<double, 2> radii, bool y_up);

}  // namespace impinge::report
