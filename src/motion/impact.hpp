// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "impinge/measures.hpp"
#include "motion/four_points.hpp"

/// Whether and when a vertex meets a face, or an edge an edge, while all vertices move on straight lines from time 0 to
/// 1: exactly, for all finite doubles. The sets are
/// closed; a face or an edge that is degenerate, or becomes so on the way, is then the segment or point that it is.
///
/// Four points that move linearly are coplanar where a cubic of time is zero (Provot, "Collision and self-collision
/// handling in cloth model dedicated to design garments", 1997). Its roots are isolated as algebraic numbers, and what
/// decides there are signs of quadratics of time. Where the cubic is zero throughout, the times at which an answer can
/// change are the roots of those quadratics.
namespace impinge::motion {

/// The first time at which they meet, between equal or neighbouring doubles; {0, 0} if and only if they meet at the
/// start.
std::optional<Interval> vertex_face_impact(const FourPoints& from, const FourPoints& to);
std::optional<Interval> edge_edge_impact(const FourPoints& from, const FourPoints& to);

}  // namespace impinge::motion
