// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"
#include "impinge/options.hpp"

/// How two proper triangles that share a point lie to each other, exactly, by signs alone.
namespace impinge::solid {

/// Whether one of them, closed, meets the interior of the other, which is open: `reaching` that of `t`. `kind` is how
/// the two meet.
bool reaches_inside(const Triangle& reaching, const Triangle& t, Kind kind);

/// Of coplanar ones: whether `cover` holds all of `t`.
bool covers(const Triangle& cover, const Triangle& t);

/// Of coplanar ones: whether their normals point the same way.
bool same_orientation(const Triangle& a, const Triangle& b);

}  // namespace impinge::solid
