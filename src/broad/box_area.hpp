// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/shapes.hpp"

namespace impinge::broad {

inline Box united(const Box& a, const Box& b) { return {min(a.lo, b.lo), max(a.hi, b.hi)}; }

/// Half the surface: what a tree's boxes are weighed by. In the exact domain it does not overflow.
inline double half_area(const Box& box) {
  const Vec3 e = box.hi - box.lo;
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace impinge::broad
