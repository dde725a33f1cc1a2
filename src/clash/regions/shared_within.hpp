// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "clash/local_frame.hpp"
#include "clash/regions/shared_part.hpp"

namespace impinge::clash {

/// What is asked for within a tolerance.
struct SharedWithinSetting {
  LocalFrame frame;
  double tolerance;               ///< in the world
  double resolution = tolerance;  ///< likewise; how finely lines are told (clash/regions/resolution.hpp)
};

struct SharedWithin {
  SharedPart shared;
  double gap = 0;  ///< the farthest that flush triangles, or an edge and what it runs along, are apart there
};

/// What two triangles that come within the tolerance of each other share up to it; corners know no edges.
///   - Flush ones share the polygon over which they lie, half-way between them. Flush are two whose planes are no more
///     than 25 degrees apart and which, wherever one lies over the other as seen along the bisector of their normals,
///     are no farther apart than the tolerance. A polygon narrower than 2^-10 of the resolution is the segment that it
///     almost is, or nothing where the two are farther apart than that.
///   - An edge that is within the resolution wherever it lies over the other triangle, and over it for more than 4 of
///     it and for longer than what they share exactly, is a segment, likewise half-way.
///   - All others share what they share exactly or, if that is nothing, the point between their nearest points.
SharedWithin shared_within(const Triangle& a, const Triangle& b, const SharedWithinSetting& setting);

/// The first of these alone: the polygon of flush ones, or what it has shrunk to. Empty of others.
SharedWithin shared_if_flush(const Triangle& a, const Triangle& b, const SharedWithinSetting& setting);

}  // namespace impinge::clash
