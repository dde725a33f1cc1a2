// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"

/// Signs of determinants of differences in floating point, where they are certain.
namespace impinge::exact {

inline constexpr int kUnsure = 2;  ///< among signs

// With eps = 2^-53 the rounding errors are at most (3 + 16 eps) eps and (7 + 56 eps) eps times the permanent as
// computed (Shewchuk 1997, section 4). 4 eps and 8 eps leave room for the rounding of the bound itself. Each product of
// two differences may lose 2^-1075 to underflow besides, and with a third difference, below 2^301, less than 2^-773;
// there are six of them, and the product with the third loses 2^-1075 itself. Differences do not underflow.
inline constexpr double kOrient2dBound = 0x1p-51, kOrient2dUnderflow = 0x1p-1070;
inline constexpr double kOrient3dBound = 0x1p-50, kOrient3dUnderflow = 0x1p-760;

/// The sign of a determinant that is off by no more than the bound; 0 is unsure.
inline int certain_sign(double determinant, double bound) {
  return int{determinant > bound} - int{determinant < -bound};
}

/// Whether three such differences may be multiplied without underflow to 0.
inline bool keeps_from_zero(double difference) { return difference == 0 || std::abs(difference) >= 0x1p-350; }
inline bool keeps_from_zero(const Vec3& d) {
  return keeps_from_zero(d.x) && keeps_from_zero(d.y) && keeps_from_zero(d.z);
}

/// A difference is zero only if it is so exactly: where products did not underflow and there is no permanent, the
/// determinant is zero. Axis-aligned data in one plane end there.
inline int filtered_orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const double px = ax - cx, py = ay - cy, qx = bx - cx, qy = by - cy;
  const double left = px * qy, right = py * qx, permanent = std::abs(left) + std::abs(right);
  if (const int sign = certain_sign(left - right, kOrient2dBound * permanent + kOrient2dUnderflow); sign != 0)
    return sign;
  return permanent == 0 && keeps_from_zero({px, py, qx}) && keeps_from_zero(qy) ? 0 : kUnsure;
}

/// A cross product of differences, and the sums of the absolute products in it.
struct FilteredNormal {
  Vec3 u, v, normal, magnitude;

  FilteredNormal(const Vec3& u_, const Vec3& v_) : u(u_), v(v_) {
    const double yz = u.y * v.z, zy = u.z * v.y, zx = u.z * v.x, xz = u.x * v.z, xy = u.x * v.y, yx = u.y * v.x;
    normal = {yz - zy, zx - xz, xy - yx};
    magnitude = {std::abs(yz) + std::abs(zy), std::abs(zx) + std::abs(xz), std::abs(xy) + std::abs(yx)};
  }
  /// Of the determinant with a third difference.
  [[nodiscard]] int sign(const Vec3& w) const {
    const double permanent = dot(abs(w), magnitude);
    if (const int sign = certain_sign(dot(w, normal), kOrient3dBound * permanent + kOrient3dUnderflow); sign != 0)
      return sign;
    return permanent == 0 && keeps_from_zero(u) && keeps_from_zero(v) && keeps_from_zero(w) ? 0 : kUnsure;
  }
  /// Which of the normal's x, y and z (1, 2, 3) is certainly not zero; 0 if none is.
  [[nodiscard]] unsigned certain_axis() const {
    const auto is_certain = [](double x, double of) { return std::abs(x) > kOrient2dBound * of + kOrient2dUnderflow; };
    return is_certain(normal.x, magnitude.x)   ? 1
           : is_certain(normal.y, magnitude.y) ? 2
           : is_certain(normal.z, magnitude.z) ? 3
                                               : 0;
  }
};

inline int filtered_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return FilteredNormal(b - a, c - a).sign(d - a);
}

}  // namespace impinge::exact
