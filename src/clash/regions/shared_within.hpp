// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "clash/regions/shared_part.hpp"
#include "core/local_frame.hpp"

namespace impinge::clash {

/// The lengths and the frame for shared_within.
struct SharedWithinSetting {
  LocalFrame frame;
  double tolerance;               ///< in the world
  double resolution = tolerance;  ///< in the world: how finely lines are resolved (Reach)
};

struct SharedWithin {
  SharedPart shared;
  double gap = 0;  ///< the greatest distance there between flush triangles, or between an edge and a triangle along it
};

/// What two triangles no farther apart than the tolerance share within it. The corners have no edges.
///   - Flush triangles share the polygon in which they overlap, half-way between them. Two triangles are flush if their
///     planes are at most 25 degrees apart and if, wherever one lies over the other along the bisector of their
///     normals, they are no farther apart than the tolerance. A polygon narrower than 2^-10 of the resolution is
///     reduced to a segment, or to nothing where the triangles are farther apart than the resolution.
///   - If an edge is within the resolution of the other triangle wherever it lies over it, along more than 4
///     resolutions and more than the triangles share exactly, they share that segment, likewise half-way.
///   - All other triangles share what they share exactly or, if that is nothing, the point between their nearest
///     points.
SharedWithin shared_within(const Triangle& a, const Triangle& b, const SharedWithinSetting& setting);

}  // namespace impinge::clash
