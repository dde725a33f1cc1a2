// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"

/// Exact relations of two proper triangles that share a point, by signs alone.
namespace impinge::solid {

/// Whether the closed triangle `reaching` meets the interior of `t`, for a pair whose kind is `touching`.
bool reaches_inside(const Triangle& reaching, const Triangle& t);

/// Whether `cover` contains `t`, for coplanar triangles.
bool covers(const Triangle& cover, const Triangle& t);

/// Whether the normals of two coplanar triangles point the same way.
bool same_orientation(const Triangle& a, const Triangle& b);

}  // namespace impinge::solid
