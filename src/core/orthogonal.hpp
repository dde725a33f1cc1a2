// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"

namespace impinge {

/// A vector without its part along d; itself if d is zero. Once more, since the first time may leave nothing but
/// rounding.
inline Vec3 orthogonal_to(const Vec3& d, Vec3 v) {
  const double dd = dot(d, d);
  if (dd > 0)
    for (int time = 0; time < 2; ++time) v = v - dot(v, d) / dd * d;
  return v;
}

}  // namespace impinge
