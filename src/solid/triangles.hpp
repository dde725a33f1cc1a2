// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"

/// How two proper triangles that share a point lie to each other, exactly, by signs alone.
namespace impinge::solid {

/// Of a pair whose kind is `touching`: whether `reaching`, closed, meets the interior of `t`, which is open.
bool reaches_inside(const Triangle& reaching, const Triangle& t);

/// Of coplanar ones: whether `cover` holds all of `t`.
bool covers(const Triangle& cover, const Triangle& t);

/// Of coplanar ones: whether their normals point the same way.
bool same_orientation(const Triangle& a, const Triangle& b);

}  // namespace impinge::solid
