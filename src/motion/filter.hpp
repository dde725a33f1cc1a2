// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/measures.hpp"
#include "motion/four_points.hpp"

/// What floating point says of moving features for certain.
namespace impinge::motion {

/// Whether they certainly never meet.
bool vertex_avoids_face(const FourPoints& from, const FourPoints& to);
bool edges_avoid(const FourPoints& from, const FourPoints& to);

/// Of features that are coplanar at one time in the interval: 1 if they certainly meet then, -1 if they certainly do
/// not, 0 if that is open.
int vertex_in_face(const FourPoints& from, const FourPoints& to, const Interval& time);
int edges_cross(const FourPoints& from, const FourPoints& to, const Interval& time);

}  // namespace impinge::motion
