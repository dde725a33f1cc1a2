// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"

namespace impinge {

/// How a body moves that turns about an axis and glides along it: a point at x moves at linear + angular × x, at any
/// time, and neither its speed nor how fast that turns ever changes.
struct Twist {
  Vec3 linear{0, 0, 0}, angular{0, 0, 0};
  double error = 0;  ///< bounds that of `linear`
};

}  // namespace impinge
