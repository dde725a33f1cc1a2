// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/shapes.hpp"

namespace impinge::clash {

/// The area of some triangles and the volume that they enclose, summed up one triangle after the other. Coordinates are
/// local (core/local_frame.hpp), so that products neither over- nor underflow.
struct AreaAndVolume {
  double area = 0, volume = 0;

  /// Adds a triangle; `side` is -1 where its normal points inward.
  void add(const Triangle& t, double side = 1) {
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    area += norm(normal) / 2, volume += side * dot(t[0], normal) / 6;
  }
  /// The thickness of a large thin plate of this volume and area.
  [[nodiscard]] double wall() const { return area > 0 ? 2 * std::abs(volume) / area : 0; }
};

}  // namespace impinge::clash
