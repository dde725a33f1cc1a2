// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/filter.hpp"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "motion/filter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/mask_bits-inl.hpp"

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
// and off by 11 u D_i D_j: off by less than (3 (11 + 2 + 2) + 5 * 6) u D_x D_y D_z; a blossom adds 12 u of 6 D_x D_y
// D_z: less than 150 u in all. The bounds below are larger by what second-order terms and their own rounding could be.
HWY_BEFORE_NAMESPACE();
namespace impinge::motion::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr double kQuadraticBound = 0x1p-46, kCubicBound = 0x1p-45;
/// Where differences are between these, products of three are far from denormals and from infinity.
constexpr double kSmallest = 0x1p-250, kLargest = 0x1p320;
constexpr int kLevels = 7;

/// One pair of features, and as many as a vector holds.
using One = hn::CappedTag<double, 1>;
using Many = hn::CappedTag<double, FourPointsBlock::kLanes>;

/// A number in each lane.
template <class D>
struct Num {
  using V = hn::Vec<D>;
  V v;
  HWY_INLINE Num() : v(hn::Zero(D())) {}
  HWY_INLINE Num(V value) : v(value) {}
  HWY_INLINE Num(double value) : v(hn::Set(D(), value)) {}
  friend HWY_INLINE Num operator+(const Num& a, const Num& b) { return hn::Add(a.v, b.v); }
  friend HWY_INLINE Num operator-(const Num& a, const Num& b) { return hn::Sub(a.v, b.v); }
  friend HWY_INLINE Num operator*(const Num& a, const Num& b) { return hn::Mul(a.v, b.v); }
  friend HWY_INLINE Num abs(const Num& a) { return hn::Abs(a.v); }
  friend HWY_INLINE Num max(const Num& a, const Num& b) { return hn::Max(a.v, b.v); }
};

/// Which lanes.
template <class D>
struct Lanes {
  hn::Mask<D> m;
  HWY_INLINE Lanes(hn::Mask<D> mask) : m(mask) {}
  friend HWY_INLINE Lanes operator&(const Lanes& a, const Lanes& b) { return hn::And(a.m, b.m); }
  friend HWY_INLINE Lanes operator|(const Lanes& a, const Lanes& b) { return hn::Or(a.m, b.m); }
  HWY_INLINE bool all() const { return hn::AllTrue(D(), m); }
};
template <class D>
HWY_INLINE Lanes<D> operator>(const Num<D>& a, const Num<D>& b) {
  return hn::Gt(a.v, b.v);
}
template <class D>
HWY_INLINE Lanes<D> above(const Num<D>& a, const Num<D>& error) {
  return a > error;
}
template <class D>
HWY_INLINE Lanes<D> below(const Num<D>& a, const Num<D>& error) {
  return hn::Lt(a.v, hn::Neg(error.v));
}

template <class N>
struct Vector {
  N x, y, z;
  friend HWY_INLINE Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend HWY_INLINE Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend HWY_INLINE Vector operator*(const N& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend HWY_INLINE N dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend HWY_INLINE Vector abs(const Vector& a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
  friend HWY_INLINE Vector max(const Vector& a, const Vector& b) {
    return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
  }
  HWY_INLINE const N& operator[](int k) const { return k == 0 ? x : k == 1 ? y : z; }
};

template <class N>
struct Moving {
  Vector<N> at0, at1;
  friend HWY_INLINE Moving operator-(const Moving& a, const Moving& b) { return {a.at0 - b.at0, a.at1 - b.at1}; }
};

/// The four points at both ends.
template <class N>
using Points = std::array<Moving<N>, 4>;

HWY_INLINE Points<Num<One>> load(const FourPoints& from, const FourPoints& to) {
  const auto vector = [](const Vec3& p) HWY_ATTR { return Vector<Num<One>>{p.x, p.y, p.z}; };
  return {Moving<Num<One>>{vector(from[0]), vector(to[0])},
          {vector(from[1]), vector(to[1])},
          {vector(from[2]), vector(to[2])},
          {vector(from[3]), vector(to[3])}};
}
HWY_INLINE Points<Num<Many>> load(const FourPointsBlock& block, std::size_t lane) {
  const auto point = [&](int i) HWY_ATTR {
    const auto vector = [&](const double(&rows)[3][FourPointsBlock::kLanes]) HWY_ATTR {
      const Many d;
      return Vector<Num<Many>>{hn::Load(d, rows[0] + lane), hn::Load(d, rows[1] + lane), hn::Load(d, rows[2] + lane)};
    };
    return Moving<Num<Many>>{vector(block.from[i]), vector(block.to[i])};
  };
  return {point(0), point(1), point(2), point(3)};
}

template <class N>
using Quadratic = std::array<Vector<N>, 3>;  // three of them, a component each

template <class N>
HWY_INLINE Quadratic<N> cross(const Moving<N>& a, const Moving<N>& b) {
  return {cross(a.at0, b.at0), N(0.5) * (cross(a.at0, b.at1) + cross(a.at1, b.at0)), cross(a.at1, b.at1)};
}
template <class N>
HWY_INLINE Quadratic<N> sum(const Quadratic<N>& a, const Quadratic<N>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class N>
HWY_INLINE Quadratic<N> difference(const Quadratic<N>& a, const Quadratic<N>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class N>
using Cubic = std::array<N, 4>;

template <class N>
HWY_INLINE Cubic<N> dot(const Moving<N>& a, const Quadratic<N>& q) {
  const N third = 1 / 3.0;
  return {dot(a.at0, q[0]), (dot(a.at1, q[0]) + N(2) * dot(a.at0, q[1])) * third,
          (dot(a.at0, q[2]) + N(2) * dot(a.at1, q[1])) * third, dot(a.at1, q[2])};
}

/// A part of the time.
struct Part {
  double start, end;
  int level;
  [[nodiscard]] bool is_all() const { return start == 0 && end == 1; }
};

template <class N>
HWY_INLINE Quadratic<N> over(const Quadratic<N>& q, const Part& part) {
  if (part.is_all()) return q;
  const auto between = [](const Vector<N>& a, const Vector<N>& b, double t)
                           HWY_ATTR { return N(1 - t) * a + N(t) * b; };
  const Vector<N> first = between(q[0], q[1], part.start), second = between(q[1], q[2], part.start);
  return {between(first, second, part.start), between(first, second, part.end),
          between(between(q[0], q[1], part.end), between(q[1], q[2], part.end), part.end)};
}

template <class N>
HWY_INLINE Cubic<N> over(const Cubic<N>& c, const Part& part) {
  if (part.is_all()) return c;
  const auto between = [](const N& a, const N& b, double t) HWY_ATTR { return N(1 - t) * a + N(t) * b; };
  const auto blossom = [&](double r, double s, double t) HWY_ATTR {
    const N a = between(c[0], c[1], r), b = between(c[1], c[2], r), d = between(c[2], c[3], r);
    return between(between(a, b, s), between(b, d, s), t);
  };
  return {blossom(part.start, part.start, part.start), blossom(part.start, part.start, part.end),
          blossom(part.start, part.end, part.end), blossom(part.end, part.end, part.end)};
}

template <class D>
HWY_INLINE Lanes<D> one_sign(const Cubic<Num<D>>& c, const Num<D>& e) {
  return (above(c[0], e) & above(c[1], e) & above(c[2], e) & above(c[3], e)) |
         (below(c[0], e) & below(c[1], e) & below(c[2], e) & below(c[3], e));
}

/// Where component k is certainly above or below 0 throughout.
template <class D>
struct Signs {
  Lanes<D> plus, minus;
  HWY_INLINE Signs(const Quadratic<Num<D>>& q, const Vector<Num<D>>& error, int k)
      : plus(above(q[0][k], error[k]) & above(q[1][k], error[k]) & above(q[2][k], error[k])),
        minus(below(q[0][k], error[k]) & below(q[1][k], error[k]) & below(q[2][k], error[k])) {}
  friend HWY_INLINE Lanes<D> equal(const Signs& a, const Signs& b) { return (a.plus & b.plus) | (a.minus & b.minus); }
  friend HWY_INLINE Lanes<D> opposite(const Signs& a, const Signs& b) {
    return (a.plus & b.minus) | (a.minus & b.plus);
  }
};

/// The largest component of the vectors along each axis.
template <class N>
HWY_INLINE Vector<N> largest(const Moving<N>& x, const Moving<N>& y, const Moving<N>& z) {
  return max(max(max(abs(x.at0), abs(x.at1)), max(abs(y.at0), abs(y.at1))), max(abs(z.at0), abs(z.at1)));
}

template <class D>
struct Bounds {
  Vector<Num<D>> quadratic;
  Num<D> cubic;
  Lanes<D> valid;

  static HWY_INLINE Lanes<D> is_safe(const Num<D>& x) {
    const D d;
    return hn::Or(hn::Eq(x.v, hn::Zero(d)),
                  hn::And(hn::Ge(x.v, hn::Set(d, kSmallest)), hn::Le(x.v, hn::Set(d, kLargest))));
  }
  explicit HWY_INLINE Bounds(const Vector<Num<D>>& size)
      : quadratic(Num<D>(kQuadraticBound) * Vector<Num<D>>{size.y * size.z, size.z * size.x, size.x * size.y}),
        cubic(Num<D>(kCubicBound) * size.x * size.y * size.z),
        valid(is_safe(size.x) & is_safe(size.y) & is_safe(size.z)) {}
};

/// What is certain of features in the time in which they are coplanar.
template <class D>
struct Verdict {
  Lanes<D> apart, meet;  ///< `meet` where not `apart`
};

/// Four quadratics whose signs along an axis decide.
template <class N>
using Sides = std::array<Quadratic<N>, 4>;

/// A vertex and a face: the face's corners as seen from the vertex.
template <class D>
struct RoundedFace {
  using N = Num<D>;
  Moving<N> x, y, z;
  Bounds<D> bounds;
  Quadratic<N> yz;
  Cubic<N> volume;

  explicit HWY_INLINE RoundedFace(const Points<N>& p)
      : x(p[1] - p[0]), y(p[2] - p[0]), z(p[3] - p[0]), bounds(largest(x, y, z)), yz(cross(y, z)), volume(dot(x, yz)) {}

  /// The areas that the vertex spans with the edges, and before them the face's, their sum: along an axis on which that
  /// is not zero, the vertex is inside if and only if none has the other sign.
  HWY_INLINE Sides<N> sides() const {
    const Quadratic<N> xy = cross(x, y), zx = cross(z, x);
    return {sum(sum(xy, yz), zx), xy, yz, zx};
  }
  static HWY_INLINE Verdict<D> along_axis(const Signs<D>& face, const Signs<D>& a, const Signs<D>& b,
                                          const Signs<D>& c) {
    return {opposite(face, a) | opposite(face, b) | opposite(face, c),
            equal(face, a) & equal(face, b) & equal(face, c)};
  }
};

/// Two edges, and the way from the first to the second.
template <class D>
struct RoundedEdges {
  using N = Num<D>;
  Moving<N> x, y, z;
  Bounds<D> bounds;
  Quadratic<N> xy;
  Cubic<N> volume;

  explicit HWY_INLINE RoundedEdges(const Points<N>& p)
      : x(p[1] - p[0]), y(p[3] - p[2]), z(p[2] - p[0]), bounds(largest(x, y, z)), xy(cross(x, y)), volume(dot(z, xy)) {}

  /// On which side of the first edge the ends of the second lie, seen along an axis; and of the second those of the
  /// first. The edges' projections meet only if neither pair is on one side, and certainly if both are on two.
  HWY_INLINE Sides<N> sides() const {
    const Quadratic<N> start_of_second = cross(x, z), start_of_first = cross(z, y);
    return {start_of_second, sum(start_of_second, xy), start_of_first, difference(start_of_first, xy)};
  }
  static HWY_INLINE Verdict<D> along_axis(const Signs<D>& a, const Signs<D>& b, const Signs<D>& c, const Signs<D>& d) {
    return {equal(a, b) | equal(c, d), opposite(a, b) & opposite(c, d)};
  }
};

template <template <class> class Features, class D>
HWY_INLINE Verdict<D> verdict_during(const Part& part, const Sides<Num<D>>& sides, const Bounds<D>& bounds) {
  const Sides<Num<D>> now{over(sides[0], part), over(sides[1], part), over(sides[2], part), over(sides[3], part)};
  Verdict<D> result{hn::FirstN(D(), 0), hn::FirstN(D(), 0)};
  for (int k = 0; k < 3; ++k) {
    const auto sign = [&](std::size_t i) HWY_ATTR { return Signs<D>(now[i], bounds.quadratic, k); };
    const Verdict<D> along = Features<D>::along_axis(sign(0), sign(1), sign(2), sign(3));
    result.apart = result.apart | along.apart;
    result.meet = result.meet | along.meet;
  }
  return result;
}

template <template <class> class Features>
HWY_INLINE std::uint32_t may_meet(const FourPointsBlock& block, double until) {
  const Many d;
  const Part part{0, until, 0};
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < FourPointsBlock::kLanes; lane += hn::Lanes(d)) {
    const Features<Many> features(load(block, lane));
    Lanes<Many> avoid = one_sign(over(features.volume, part), features.bounds.cubic);
    if (!avoid.all()) avoid = avoid | verdict_during<Features>(part, features.sides(), features.bounds).apart;
    const Lanes<Many> certain = avoid & features.bounds.valid;
    bits |= (impinge::HWY_NAMESPACE::mask_bits(d, certain.m) ^ ((1u << hn::Lanes(d)) - 1)) << lane;
  }
  return bits;
}

template <template <class> class Features>
HWY_INLINE bool avoid(const FourPoints& from, const FourPoints& to) {
  const Features<One> features(load(from, to));
  if (!features.bounds.valid.all()) return false;
  const Sides<Num<One>> sides = features.sides();
  std::array<Part, kLevels + 1> parts{Part{0, 1, 0}};
  for (int count = 1; count > 0;) {
    const Part part = parts[--count];
    if (one_sign(over(features.volume, part), features.bounds.cubic).all()) continue;
    if (verdict_during<Features>(part, sides, features.bounds).apart.all()) continue;
    if (part.level == kLevels) return false;
    const double middle = (part.start + part.end) / 2;
    parts[count++] = {middle, part.end, part.level + 1};
    parts[count++] = {part.start, middle, part.level + 1};
  }
  return true;
}

template <template <class> class Features>
HWY_INLINE int meet(const FourPoints& from, const FourPoints& to, const Interval& time) {
  const Features<One> features(load(from, to));
  if (!features.bounds.valid.all()) return 0;
  const Verdict<One> verdict = verdict_during<Features>({time.lo, time.hi, 0}, features.sides(), features.bounds);
  return verdict.apart.all() ? -1 : int{verdict.meet.all()};
}

std::uint32_t faces_may_meet(const FourPointsBlock& block, double until) { return may_meet<RoundedFace>(block, until); }
std::uint32_t edges_may_meet(const FourPointsBlock& block, double until) {
  return may_meet<RoundedEdges>(block, until);
}
bool vertex_avoids_face(const FourPoints& from, const FourPoints& to) { return avoid<RoundedFace>(from, to); }
bool edges_avoid(const FourPoints& from, const FourPoints& to) { return avoid<RoundedEdges>(from, to); }
int vertex_in_face(const FourPoints& from, const FourPoints& to, const Interval& time) {
  return meet<RoundedFace>(from, to, time);
}
int edges_cross(const FourPoints& from, const FourPoints& to, const Interval& time) {
  return meet<RoundedEdges>(from, to, time);
}

}  // namespace impinge::motion::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::motion {

HWY_EXPORT(faces_may_meet);
HWY_EXPORT(edges_may_meet);
HWY_EXPORT(vertex_avoids_face);
HWY_EXPORT(edges_avoid);
HWY_EXPORT(vertex_in_face);
HWY_EXPORT(edges_cross);

std::uint32_t faces_may_meet(const FourPointsBlock& block, double until) {
  return HWY_DYNAMIC_DISPATCH(faces_may_meet)(block, until);
}
std::uint32_t edges_may_meet(const FourPointsBlock& block, double until) {
  return HWY_DYNAMIC_DISPATCH(edges_may_meet)(block, until);
}
bool vertex_avoids_face(const FourPoints& from, const FourPoints& to) {
  return HWY_DYNAMIC_DISPATCH(vertex_avoids_face)(from, to);
}
bool edges_avoid(const FourPoints& from, const FourPoints& to) { return HWY_DYNAMIC_DISPATCH(edges_avoid)(from, to); }
int vertex_in_face(const FourPoints& from, const FourPoints& to, const Interval& time) {
  return HWY_DYNAMIC_DISPATCH(vertex_in_face)(from, to, time);
}
int edges_cross(const FourPoints& from, const FourPoints& to, const Interval& time) {
  return HWY_DYNAMIC_DISPATCH(edges_cross)(from, to, time);
}

}  // namespace impinge::motion
#endif
