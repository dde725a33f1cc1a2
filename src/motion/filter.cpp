// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

// Everything is made of three difference vectors x, y, z that move linearly, at both ends: of the corners of the face
// from the vertex; or of the first edge, the second one, and the way from the first to the second. Their cross products
// are quadratics of time, their determinant is the cubic that is zero where the four points are coplanar. Both are kept
// in Bernstein form over [0, 1], and evaluated over parts of it as blossoms (Farin, "Curves and Surfaces for CAGD",
// section 3.4), whose values are combinations of the coefficients with weights that add up to 1.
//
// Let D_k be the largest |component k| of the six vectors as computed, u = 2^-53. A computed difference is off by u of
// itself. A component of a cross product is a sum of two products below D_i D_j, at the ends; the middle coefficient is
// half the sum of four. Each product is off by 3 u of itself (two differences, one rounding), sums add 2 u of their
// absolute terms: 11 u D_i D_j at most. Sums of up to three such numbers are off by 3 times that and 2 u of 6 D_i D_j;
// blossoms, by two levels of two products and a sum each and weights that are off by u, add 8 u of at most 6 D_i D_j:
// less than 100 u D_i D_j.
// A coefficient of the determinant is a mean of sums of three products of D_k and components that are below 2 D_i D_j
// and off by 11 u D_i D_j: off by less than (3 (11 + 2 + 2) + 4 * 6) u D_x D_y D_z; a blossom adds 12 u of 6 D_x D_y
// D_z: less than 150 u in all. The bounds below are larger by what second-order terms and their own rounding could be.
namespace impinge::motion {

namespace {

constexpr double kQuadraticBound = 0x1p-46, kCubicBound = 0x1p-45;
/// Where differences are between these, products of three are far from denormals and from infinity.
constexpr double kSmallest = 0x1p-250, kLargest = 0x1p320;
constexpr int kLevels = 7;

struct Moving {
  Vec3 at0, at1;
};

using Quadratic = std::array<Vec3, 3>;  // three of them, a component each

Quadratic cross(const Moving& a, const Moving& b) {
  return {impinge::cross(a.at0, b.at0), 0.5 * (impinge::cross(a.at0, b.at1) + impinge::cross(a.at1, b.at0)),
          impinge::cross(a.at1, b.at1)};
}
Quadratic operator+(const Quadratic& a, const Quadratic& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Quadratic operator-(const Quadratic& a, const Quadratic& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

using Cubic = std::array<double, 4>;

Cubic dot(const Moving& a, const Quadratic& q) {
  return {impinge::dot(a.at0, q[0]), (impinge::dot(a.at1, q[0]) + 2 * impinge::dot(a.at0, q[1])) / 3,
          (impinge::dot(a.at0, q[2]) + 2 * impinge::dot(a.at1, q[1])) / 3, impinge::dot(a.at1, q[2])};
}

/// A part of the time.
struct Part {
  double start, end;
  int level;
};

Quadratic over(const Quadratic& q, const Part& part) {
  const auto between = [](const Vec3& a, const Vec3& b, double t) { return (1 - t) * a + t * b; };
  const Vec3 first = between(q[0], q[1], part.start), second = between(q[1], q[2], part.start);
  return {between(first, second, part.start), between(first, second, part.end),
          between(between(q[0], q[1], part.end), between(q[1], q[2], part.end), part.end)};
}

Cubic over(const Cubic& c, const Part& part) {
  const auto between = [](double a, double b, double t) { return (1 - t) * a + t * b; };
  const auto blossom = [&](double r, double s, double t) {
    const double a = between(c[0], c[1], r), b = between(c[1], c[2], r), d = between(c[2], c[3], r);
    return between(between(a, b, s), between(b, d, s), t);
  };
  return {blossom(part.start, part.start, part.start), blossom(part.start, part.start, part.end),
          blossom(part.start, part.end, part.end), blossom(part.end, part.end, part.end)};
}

bool one_sign(const Cubic& c, double error) {
  return (c[0] > error && c[1] > error && c[2] > error && c[3] > error) ||
         (c[0] < -error && c[1] < -error && c[2] < -error && c[3] < -error);
}

/// Of each component: 1, -1, or 0 where it is not certain throughout.
std::array<int, 3> signs(const Quadratic& q, const Vec3& error) {
  std::array<int, 3> result;
  for (int k = 0; k < 3; ++k) {
    const double a = component(q[0], k), b = component(q[1], k), c = component(q[2], k), e = component(error, k);
    result[k] = int{a > e && b > e && c > e} - int{a < -e && b < -e && c < -e};
  }
  return result;
}

/// The largest component of the vectors along each axis.
Vec3 largest(const Moving& x, const Moving& y, const Moving& z) {
  return max(max(max(abs(x.at0), abs(x.at1)), max(abs(y.at0), abs(y.at1))), max(abs(z.at0), abs(z.at1)));
}

struct Bounds {
  Vec3 quadratic;
  double cubic;
  bool valid;

  static bool is_safe(double x) { return x == 0 || (x >= kSmallest && x <= kLargest); }
  explicit Bounds(const Vec3& d)
      : quadratic(kQuadraticBound * Vec3{d.y * d.z, d.z * d.x, d.x * d.y}),
        cubic(kCubicBound * d.x * d.y * d.z),
        valid(is_safe(d.x) && is_safe(d.y) && is_safe(d.z)) {}
};

/// A vertex and a face: the face's corners as seen from the vertex.
struct RoundedFace {
  Moving x, y, z;
  Bounds bounds;
  Quadratic yz;
  Cubic volume;

  RoundedFace(const FourPoints& from, const FourPoints& to)
      : x{from[1] - from[0], to[1] - to[0]},
        y{from[2] - from[0], to[2] - to[0]},
        z{from[3] - from[0], to[3] - to[0]},
        bounds(largest(x, y, z)),
        yz(cross(y, z)),
        volume(dot(x, yz)) {}

  /// By the areas that the vertex spans with the edges, which add up to the face's: along an axis on which that is not
  /// zero, the vertex is inside if and only if none has the other sign.
  struct Sides {
    Bounds bounds;
    std::array<Quadratic, 3> sides;
    Quadratic normal;

    explicit Sides(const RoundedFace& of)
        : bounds(of.bounds),
          sides{cross(of.x, of.y), of.yz, cross(of.z, of.x)},
          normal(sides[0] + sides[1] + sides[2]) {}

    [[nodiscard]] int meet(const Part& part) const {
      const auto way = signs(over(normal, part), bounds.quadratic);
      std::array<int, 3> inside{1, 1, 1};
      for (const Quadratic& side : sides) {
        const auto here = signs(over(side, part), bounds.quadratic);
        for (int k = 0; k < 3; ++k) {
          if (here[k] * way[k] < 0) return -1;
          inside[k] &= int{here[k] * way[k] > 0};
        }
      }
      return inside[0] | inside[1] | inside[2];
    }
  };
};

/// Two edges, and the way from the first to the second.
struct RoundedEdges {
  Moving x, y, z;
  Bounds bounds;
  Quadratic xy;
  Cubic volume;

  RoundedEdges(const FourPoints& from, const FourPoints& to)
      : x{from[1] - from[0], to[1] - to[0]},
        y{from[3] - from[2], to[3] - to[2]},
        z{from[2] - from[0], to[2] - to[0]},
        bounds(largest(x, y, z)),
        xy(cross(x, y)),
        volume(dot(z, xy)) {}

  /// On which side of the first edge the ends of the second lie, seen along an axis; and of the second those of the
  /// first. The edges' projections meet only if neither pair is on one side, and certainly if both are on two.
  struct Sides {
    Bounds bounds;
    Quadratic start_of_second, end_of_second, start_of_first, end_of_first;

    explicit Sides(const RoundedEdges& of)
        : bounds(of.bounds),
          start_of_second(cross(of.x, of.z)),
          end_of_second(start_of_second + of.xy),
          start_of_first(cross(of.z, of.y)),
          end_of_first(start_of_first - of.xy) {}

    [[nodiscard]] int meet(const Part& part) const {
      const auto sides = [&](const Quadratic& one, const Quadratic& two) {
        const auto a = signs(over(one, part), bounds.quadratic), b = signs(over(two, part), bounds.quadratic);
        return std::array{a[0] * b[0], a[1] * b[1], a[2] * b[2]};
      };
      const auto second = sides(start_of_second, end_of_second);
      if (std::max({second[0], second[1], second[2]}) > 0) return -1;
      const auto first = sides(start_of_first, end_of_first);
      if (std::max({first[0], first[1], first[2]}) > 0) return -1;
      for (int k = 0; k < 3; ++k)
        if (first[k] < 0 && second[k] < 0) return 1;
      return 0;
    }
  };
};

template <class Features>
bool avoid(const FourPoints& from, const FourPoints& to) {
  const Features features(from, to);
  if (!features.bounds.valid) return false;
  if (one_sign(features.volume, features.bounds.cubic)) return true;
  const typename Features::Sides sides(features);
  std::array<Part, kLevels + 1> parts{Part{0, 1, 0}};
  for (int count = 1; count > 0;) {
    const Part part = parts[--count];
    if (part.level > 0 && one_sign(over(features.volume, part), features.bounds.cubic)) continue;
    if (sides.meet(part) < 0) continue;
    if (part.level == kLevels) return false;
    const double middle = (part.start + part.end) / 2;
    parts[count++] = {middle, part.end, part.level + 1};
    parts[count++] = {part.start, middle, part.level + 1};
  }
  return true;
}

template <class Features>
int meet(const FourPoints& from, const FourPoints& to, const Interval& time) {
  const Features features(from, to);
  return features.bounds.valid ? typename Features::Sides(features).meet({time.lo, time.hi, 0}) : 0;
}

}  // namespace

bool vertex_avoids_face(const FourPoints& from, const FourPoints& to) { return avoid<RoundedFace>(from, to); }
bool edges_avoid(const FourPoints& from, const FourPoints& to) { return avoid<RoundedEdges>(from, to); }

int vertex_in_face(const FourPoints& from, const FourPoints& to, const Interval& time) {
  return meet<RoundedFace>(from, to, time);
}
int edges_cross(const FourPoints& from, const FourPoints& to, const Interval& time) {
  return meet<RoundedEdges>(from, to, time);
}

}  // namespace impinge::motion
