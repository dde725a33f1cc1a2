// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/vec3.hpp"

namespace impinge::motion {

/// At one end of the motion: a vertex and the corners of a face, or the ends of one edge and of another.
using FourPoints = std::array<Vec3, 4>;

}  // namespace impinge::motion
