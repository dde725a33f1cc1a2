// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "clash/depth.hpp"

namespace impinge::clash {

/// How far from a point its winding number stays on its side of 1/2, on every way that meets no triangle.
///
/// Go on through triangles as if they were not there, and the number is a harmonic function wherever no open edge is.
/// If it stays on one side of an integer and is off it by v at the centre of a ball without open edges, it is off it by
/// v (1 + q) / (1 - q)^2 at most within the share q of the radius (Harnack's inequality). That is at most 1/4 within
/// the share returned. v counts as 2^-6 more: the number is in error, and may pass the integer by a little.
double reach_of_side(const Winding& winding, double number, const Vec3& point, double within);

/// Finds out on which side of the outer body those triangles of the inner one lie that touch none of its triangles.
/// Neighbours over a vertex lie on one side, as far as no open edge is near, so that one winding number serves many.
class PatchSides {
 public:
  /// Of the candidates alone.
  PatchSides(const DepthSearch& search, std::span<const std::uint32_t> candidates);
  /// Whether a triangle is inside; nothing where that is not known of all of it.
  std::optional<bool> is_inside(std::uint32_t triangle);

 private:
  enum class Side : std::uint8_t { touching, unknown, inside, outside };
  [[nodiscard]] const std::array<std::uint32_t, 3>& corners(std::uint32_t triangle) const {
    return inner_.placed.mesh->triangles[triangle];
  }
  void list_fans(std::span<const std::uint32_t> candidates);
  void look_around(std::uint32_t first);

  const solid::Body &inner_, &outer_;
  const Winding& winding_;
  std::vector<Side> side_;                     ///< per triangle
  std::vector<std::uint32_t> offsets_, fans_;  ///< per vertex the free triangles that use it, in compressed rows
  std::vector<std::uint32_t> patch_;
};

}  // namespace impinge::clash
