// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec3.hpp"

/// Signs of determinants: a floating-point filter first, expansions where it cannot tell. Exact in the domain of
/// CONTRACT 3, in round-to-nearest.
namespace impinge::exact {

/// +1 if (a, b, c) turn counter-clockwise, -1 clockwise, 0 if collinear.
int orient2d(double ax, double ay, double bx, double by, double cx, double cy);

/// Sign of det(b - a, c - a, d - a).
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of det(a1 - a0, b1 - b0, c1 - c0).
int determinant_sign(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1, const Vec3& c0, const Vec3& c1);

/// The coordinate planes: a point of space without its x, y or z.
struct Projection {
  int u, v;
};
inline constexpr std::array<Projection, 3> kProjections{{{1, 2}, {2, 0}, {0, 1}}};

inline int orient2d(const Projection& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  return orient2d(component(a, p.u), component(a, p.v), component(b, p.u), component(b, p.v), component(c, p.u),
                  component(c, p.v));
}

}  // namespace impinge::exact
