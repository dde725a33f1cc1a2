// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/vec3.hpp"
#include "exact/expansion.hpp"

/// Signs of determinants: a floating-point filter first, integers or expansions where it cannot tell. Exact for all
/// doubles below 2^300, in round-to-nearest; fast where they are multiples of 2^-358 too.
namespace impinge::exact {

/// +1 if (a, b, c) turn counter-clockwise, -1 clockwise, 0 if collinear.
int orient2d(double ax, double ay, double bx, double by, double cx, double cy);

/// Sign of det(b - a, c - a, d - a).
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// For several orient3d(a, b, c, d) of points that do not fit into integers.
class Plane {
 public:
  Plane(const Vec3& a, const Vec3& b, const Vec3& c) : a_(a), b_(b), c_(c) {}
  [[nodiscard]] int side(const Vec3& d);

 private:
  Vec3 a_, b_, c_;
  std::optional<std::array<Expansion<16>, 3>> normal_;  ///< made when floating point first cannot tell
};
inline Plane plane_through(const Vec3& a, const Vec3& b, const Vec3& c) { return {a, b, c}; }

/// Sign of det(b - a, c - a, to - from): to which side of the plane through a, b, c a step goes.
int side_of_step(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& from, const Vec3& to);

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
