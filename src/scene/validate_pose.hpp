// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/mesh.hpp"
#include "impinge/result.hpp"

namespace impinge::scene {

/// The bound of contract 1.2 for max|RᵀR - I|.
inline constexpr double kMostDefect = 1e-6;

/// Contract 1.2: finite, det R > 0 and max|RᵀR - I| <= kMostDefect, or another bound.
Result<void> validate(const Pose& pose, double most_defect = kMostDefect);

}  // namespace impinge::scene
