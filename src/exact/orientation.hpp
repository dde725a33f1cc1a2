// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/vec3.hpp"
#include "exact/expansion.hpp"

/// Signs of determinants: a floating-point filter first, expansions where it cannot tell. Exact in the domain of
/// CONTRACT 3, in round-to-nearest.
namespace impinge::exact {

/// +1 if (a, b, c) turn counter-clockwise, -1 clockwise, 0 if collinear.
int orient2d(double ax, double ay, double bx, double by, double cx, double cy);

/// Sign of det(b - a, c - a, d - a).
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The plane through three points, against which several others are held: what they share is computed once.
class Plane {
 public:
  Plane(const Vec3& a, const Vec3& b, const Vec3& c);

  /// orient3d(a, b, c, d).
  [[nodiscard]] int side(const Vec3& d) { return sign_along(a_, d); }
  /// Sign of det(b - a, c - a, to - from): on which side a step ends.
  [[nodiscard]] int sign_along(const Vec3& from, const Vec3& to);

 private:
  Vec3 a_, b_, c_;
  Vec3 normal_, magnitude_;  ///< (b - a) x (c - a) in floating point, and the sums of the absolute products in it

  // Made when floating point first cannot tell.
  struct Twofold {
    bool edges_are_doubles;     ///< b - a and c - a, exactly
    std::array<Two, 3> normal;  ///< if so, the normal to twice the precision
  };
  std::optional<Twofold> twofold_;
  std::optional<std::array<Expansion<16>, 3>> exact_normal_;
};

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
