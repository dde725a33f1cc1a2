// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "impinge/measures.hpp"
#include "motion/four_points.hpp"

/// What floating point says of moving features for certain.
namespace impinge::motion {

/// Eight times four points, a lane each: axis by axis.
struct alignas(64) FourPointsBlock {
  static constexpr int kLanes = 8;
  double from[4][3][kLanes], to[4][3][kLanes];
};

/// A bit for each lane where it is open whether the vertex meets the face, or the edges meet, until a time. Quicker
/// than what follows, and less sharp.
std::uint32_t faces_may_meet(const FourPointsBlock& block, double until);
std::uint32_t edges_may_meet(const FourPointsBlock& block, double until);

/// Whether they certainly never meet.
bool vertex_avoids_face(const FourPoints& from, const FourPoints& to);
bool edges_avoid(const FourPoints& from, const FourPoints& to);

/// Of features that are coplanar at one time in the interval: 1 if they certainly meet then, -1 if they certainly do
/// not, 0 if that is open.
int vertex_in_face(const FourPoints& from, const FourPoints& to, const Interval& time);
int edges_cross(const FourPoints& from, const FourPoints& to, const Interval& time);

}  // namespace impinge::motion
