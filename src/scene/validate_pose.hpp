// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/mesh.hpp"
#include "impinge/result.hpp"

namespace impinge::scene {

/// Contract 1.2: finite, det R > 0 and max|RᵀR - I| <= 1e-6.
Result<void> validate(const Pose& pose);

}  // namespace impinge::scene
