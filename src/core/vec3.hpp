// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/strict_arithmetic.hpp"
#include "impinge/mesh.hpp"

namespace impinge {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Vec3 = Point;

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, const Vec3& v) { return {s * v.x, s * v.y, s * v.z}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec3 abs(const Vec3& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }
inline Vec3 min(const Vec3& a, const Vec3& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
inline Vec3 max(const Vec3& a, const Vec3& b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
inline double max_component(const Vec3& v) { return std::max({v.x, v.y, v.z}); }
inline double sum(const Vec3& v) { return v.x + v.y + v.z; }
inline double norm(const Vec3& v) { return std::sqrt(dot(v, v)); }
inline double component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Row-major.
using Mat3 = std::array<Vec3, 3>;

inline Vec3 operator*(const Mat3& m, const Vec3& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }
inline Mat3 to_mat3(const std::array<double, 9>& m) {
  return {Vec3{m[0], m[1], m[2]}, Vec3{m[3], m[4], m[5]}, Vec3{m[6], m[7], m[8]}};
}
inline Mat3 transpose(const Mat3& m) {
  return {Vec3{m[0].x, m[1].x, m[2].x}, Vec3{m[0].y, m[1].y, m[2].y}, Vec3{m[0].z, m[1].z, m[2].z}};
}
inline Mat3 operator*(const Mat3& a, const Mat3& b) {
  const Mat3 columns = transpose(b);
  return {columns * a[0], columns * a[1], columns * a[2]};
}
inline double determinant(const Mat3& m) { return dot(m[0], cross(m[1], m[2])); }
inline Mat3 inverse(const Mat3& m) {
  const double scale = 1 / determinant(m);
  return transpose({scale * cross(m[1], m[2]), scale * cross(m[2], m[0]), scale * cross(m[0], m[1])});
}

}  // namespace impinge
