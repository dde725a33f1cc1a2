// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "motion/four_points.hpp"

/// When a vertex and a face, or two edges, come within a distance of each other while all vertices move on straight
/// lines from time 0 to 1: certified, but not exact.
namespace impinge::motion {

struct Approach {
  double time;  ///< before this they are farther apart than the separation
  Vec3 normal;  ///< then, of unit length, from the second feature to the first; zero where these have a point in common
};

/// Nothing: they are farther apart than the separation until `end`. Else they are at no more than the separation and
/// the tolerance at the time that is returned. The tolerance is 2^-10 of the separation, and 2^-32 of the largest
/// difference between coordinates of the first point and another one at either end. The time does not depend on `end`.
/// A face or an edge that is degenerate, or becomes so on the way, is then the segment or point that it is.
std::optional<Approach> vertex_face_approach(const FourPoints& from, const FourPoints& to, double separation,
                                             double end);
std::optional<Approach> edge_edge_approach(const FourPoints& from, const FourPoints& to, double separation, double end);

}  // namespace impinge::motion
