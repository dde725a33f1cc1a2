// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"

/// Signs of determinants of differences in floating point, where they are certain.
namespace impinge::exact {

inline constexpr int kUnsure = 2;  ///< among signs

// With eps = 2^-53 the rounding errors are at most (3 + 16 eps) eps and (7 + 56 eps) eps times the permanent as
// computed (Shewchuk 1997, section 4). 4 eps and 8 eps leave room for the rounding of the bound itself. Nothing
// underflows on the way: in the domain differences are multiples of 2^-358, so products of three are multiples of
// 2^-1074, the smallest denormal, and what is below 2^-1022 is computed without error.
inline constexpr double kOrient2dBound = 0x1p-51;
inline constexpr double kOrient3dBound = 0x1p-50;

/// A difference is zero only if it is so exactly, and products do not underflow: without a permanent the determinant is
/// zero. Axis-aligned data in one plane end there.
inline int certain_sign(double determinant, double permanent, double bound) {
  if (determinant > bound * permanent) return 1;
  if (determinant < -bound * permanent) return -1;
  return permanent == 0 ? 0 : kUnsure;
}

inline int filtered_orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const double left = (ax - cx) * (by - cy), right = (ay - cy) * (bx - cx);
  return certain_sign(left - right, std::abs(left) + std::abs(right), kOrient2dBound);
}

/// A cross product of differences, and the sums of the absolute products in it.
struct FilteredNormal {
  Vec3 normal, magnitude;

  FilteredNormal(const Vec3& u, const Vec3& v) {
    const double yz = u.y * v.z, zy = u.z * v.y, zx = u.z * v.x, xz = u.x * v.z, xy = u.x * v.y, yx = u.y * v.x;
    normal = {yz - zy, zx - xz, xy - yx};
    magnitude = {std::abs(yz) + std::abs(zy), std::abs(zx) + std::abs(xz), std::abs(xy) + std::abs(yx)};
  }
  /// Of the determinant with a third difference.
  [[nodiscard]] int sign(const Vec3& w) const {
    return certain_sign(dot(w, normal), dot(abs(w), magnitude), kOrient3dBound);
  }
  /// Which of the normal's x, y and z (1, 2, 3) is certainly not zero; 0 if none is.
  [[nodiscard]] unsigned certain_axis() const {
    if (std::abs(normal.x) > kOrient2dBound * magnitude.x) return 1;
    if (std::abs(normal.y) > kOrient2dBound * magnitude.y) return 2;
    return std::abs(normal.z) > kOrient2dBound * magnitude.z ? 3 : 0;
  }
};

inline int filtered_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return FilteredNormal(b - a, c - a).sign(d - a);
}

}  // namespace impinge::exact
