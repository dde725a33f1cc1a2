// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "core/vec3.hpp"

namespace impinge::solid {

/// Of each corner of eight triangles the x, y and z of all.
struct EightTriangles {
  static constexpr std::size_t kCount = 8;
  alignas(64) std::array<std::array<std::array<double, kCount>, 3>, 3> corners;
};

/// Adds up the solid angles of triangles, positive behind them.
///
/// Half of a triangle's is the angle of a complex number (Van Oosterom and Strackee, "The Solid Angle of a Plane
/// Triangle", 1983). The numbers are multiplied, as most of the time would go into arctangents: there is one product
/// for each place among the eight. The angle of a product is within half a round, so that the sum is a round more where
/// both factors turn one way and the product the other.
class SolidAngles {
 public:
  SolidAngles() { x_.fill(1); }

  /// A triangle adds nothing where the point is on one of its edges.
  void add(const EightTriangles& triangles, const Vec3& from);
  [[nodiscard]] double sum() const;

 private:
  using Lanes = std::array<double, EightTriangles::kCount>;
  alignas(64) Lanes x_;
  alignas(64) Lanes y_{}, rounds_{};
};

}  // namespace impinge::solid
