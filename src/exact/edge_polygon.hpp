// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "core/vec3.hpp"
#include "exact/orientation.hpp"

namespace impinge::exact {

/// Three vertices that span a polygon's plane, and a projection injective on it; `projection` is -1 where all are
/// collinear.
struct PolygonPlane {
  Triangle frame;
  int projection;
};
PolygonPlane find_plane(std::span<const Vec3> polygon);

/// Whether an edge meets a simple polygon, boundary included, whose vertices lie in `plane`.
bool intersects(const Segment& edge, std::span<const Vec3> polygon, const PolygonPlane& plane);

}  // namespace impinge::exact
