// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"
#include "hierarchy/wide_leaf.hpp"

namespace impinge::hierarchy {

/// Axis i of a frame, as a vector.
inline Vec3 axis_of(const Frame& frame, int i) { return {frame.axes[0][i], frame.axes[1][i], frame.axes[2][i]}; }

/// Gives `to` axes for a shape that has moved and deformed since `from` was fitted to it. `carried[i]` is where axis i
/// has gone, in any length: the longest keeps its direction, the others are made perpendicular (Gram and Schmidt), and
/// an old axis stands in for one that vanishes. As right- or left-handed as they were, and orthonormal to within the
/// rounding of floats.
void carry_axes(const Mat3& carried, const Frame& from, Frame& to);

/// The axes of a leaf whose corners are now at `points`, rows of x, of y and of z of 3 * stride each, in the leaf's
/// order.
void carry_leaf_axes(const WideLeaf& old, const double* points, Frame& to);

}  // namespace impinge::hierarchy
