// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "core/vec3.hpp"
#include "hierarchy/frame.hpp"
#include "hierarchy/refit_plan.hpp"

namespace impinge::hierarchy {

/// Axis i of a frame, as a vector.
inline Vec3 axis_of(const Frame& frame, int i) { return {frame.axes[0][i], frame.axes[1][i], frame.axes[2][i]}; }

/// Gives `to` the axes of a part whose samples are now at `points`: the one that has become the longest keeps its
/// direction, the others are made perpendicular (Gram and Schmidt), and an old axis stands in for one that vanishes. As
/// right- or left-handed as they were, and orthonormal to within the rounding of floats.
void carry_axes(const RefitPlan::Axes& from, std::span<const RefitPlan::Sample> samples, const Vec3* points, Frame& to);

}  // namespace impinge::hierarchy
