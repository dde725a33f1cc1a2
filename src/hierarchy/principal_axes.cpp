// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/principal_axes.hpp"

#include <algorithm>
#include <cmath>

#include "core/vec3.hpp"

namespace impinge::hierarchy {
namespace {

struct Symmetric {
  double xx, yy, zz, xy, yz, zx;
};

double trace(const Symmetric& m) { return m.xx + m.yy + m.zz; }

Symmetric adjugate(const Symmetric& m) {
  return {m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.zx * m.zx, m.xx * m.yy - m.xy * m.xy,
          m.zx * m.yz - m.xy * m.zz, m.xy * m.zx - m.yz * m.xx, m.xy * m.yz - m.zx * m.yy};
}

Symmetric squared(const Symmetric& m) {
  return {m.xx * m.xx + m.xy * m.xy + m.zx * m.zx, m.xy * m.xy + m.yy * m.yy + m.yz * m.yz,
          m.zx * m.zx + m.yz * m.yz + m.zz * m.zz, m.xx * m.xy + m.xy * m.yy + m.zx * m.yz,
          m.xy * m.zx + m.yy * m.yz + m.yz * m.zz, m.xx * m.zx + m.xy * m.yz + m.zx * m.zz};
}

Vec3 product(const Symmetric& m, const Vec3& v) {
  return {m.xx * v.x + m.xy * v.y + m.zx * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
          m.zx * v.x + m.yz * v.y + m.zz * v.z};
}

/// The largest column, as a unit vector: where one eigenvalue dwarfs the others, its eigenvector.
Vec3 largest_column(const Symmetric& m) {
  const Vec3 column = m.xx >= m.yy ? (m.xx >= m.zz ? Vec3{m.xx, m.xy, m.zx} : Vec3{m.zx, m.yz, m.zz})
                                   : (m.yy >= m.zz ? Vec3{m.xy, m.yy, m.yz} : Vec3{m.zx, m.yz, m.zz});
  return 1 / norm(column) * column;
}

/// Two unit vectors orthogonal to n and to each other (Duff et al., "Building an Orthonormal Basis, Revisited", 2017).
std::array<Vec3, 2> across(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {Vec3{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, Vec3{b, sign + n.y * n.y * a, -n.y}};
}

/// n is an axis; the other two are the eigenvectors in the plane across it.
Mat3 completed(const Symmetric& m, const Vec3& n) {
  const auto [u, v] = across(n);
  const Vec3 mu = product(m, u);
  // [a b; b d] is cleared by a turn through theta with tan(2 theta) = 2b / (a - d).
  const double difference = dot(u, mu) - dot(v, product(m, v)), twice = 2 * dot(v, mu);
  const double r = std::sqrt(difference * difference + twice * twice);
  if (!(r > 0)) return {n, u, v};
  const double more = std::sqrt(0.5 + 0.5 * std::abs(difference) / r), less = 0.5 * twice / (r * more);
  const double c = difference >= 0 ? more : std::abs(less), s = difference >= 0 ? less : std::copysign(more, twice);
  return {n, c * u + s * v, c * v - s * u};
}

Mat3 eigenvectors(const Symmetric& unscaled) {
  const double sum = trace(unscaled);
  if (!(sum > 0)) return {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const double scale = 1 / sum;
  const Symmetric m{scale * unscaled.xx, scale * unscaled.yy, scale * unscaled.zz,
                    scale * unscaled.xy, scale * unscaled.yz, scale * unscaled.zx};
  // The adjugate's largest eigenvalue belongs to the smallest of m, and the smaller that is beside the second, the more
  // it stands out; its 16th power leaves nothing else. Where there is no second, all points are on a line. As small as
  // this, that power's square is still no denormal, and single precision can hardly tell it from nothing.
  constexpr double kLine = 1e-8;
  Symmetric power = adjugate(m);
  if (!(trace(power) > kLine)) return completed(m, largest_column(m));
  for (int i = 0; i < 4; ++i) power = squared(power);
  return completed(m, largest_column(power));
}

}  // namespace

void principal_axes(const std::array<double, 6>& matrix, float axes[3][4]) {
  const auto& [xx, yy, zz, xy, yz, zx] = matrix;
  // Orthonormal to a few 2^-53; rounding turns each row by at most sqrt(3) 2^-25.
  const Mat3 rows = eigenvectors({xx, yy, zz, xy, yz, zx});
  for (int l = 0; l < 3; ++l) {
    for (std::size_t i = 0; i < 3; ++i) axes[l][i] = static_cast<float>(component(rows[i], l));
    axes[l][3] = 0;
  }
}

}  // namespace impinge::hierarchy
