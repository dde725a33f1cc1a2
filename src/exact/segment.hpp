// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"
#include "exact/orientation.hpp"

/// Exact tests of points and segments, all closed; a segment may be a point.
namespace impinge::exact {

/// A coordinate plane onto which the three points project without becoming collinear; -1 if they are collinear.
/// The projection is then injective on their plane, so that plane geometry can be decided there.
int find_projection(const Vec3& a, const Vec3& b, const Vec3& c);
/// Whether the triangle has an area.
inline bool is_proper(const Triangle& t) { return find_projection(t[0], t[1], t[2]) >= 0; }

/// The two extreme ones of three collinear points.
Segment extremes(const Triangle& collinear);

bool intersects(const Vec3& point, const Segment& segment);
bool intersects(const Segment& a, const Segment& b);

/// Both sets lie in the plane of `triangle`, which is proper; `p` is an injective projection of that plane.
bool intersects_in_plane(const Segment& segment, const Triangle& triangle, const Projection& p);

/// `triangle` is proper.
bool intersects(const Segment& segment, const Triangle& triangle);

}  // namespace impinge::exact
