// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Compiled once an instruction set: included after hwy/foreach_target.h, by that header's rules.
#if defined(IMPINGE_TRIANGLE_PAIR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IMPINGE_TRIANGLE_PAIR_INL
#undef IMPINGE_TRIANGLE_PAIR_INL
#else
#define IMPINGE_TRIANGLE_PAIR_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace impinge::narrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Three coordinates in each lane.
template <class V>
struct Vec {
  V x, y, z;
};

template <class V>
HWY_INLINE Vec<V> operator-(const Vec<V>& a, const Vec<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V>
HWY_INLINE Vec<V> cross(const Vec<V>& a, const Vec<V>& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
template <class V>
HWY_INLINE V dot(const Vec<V>& a, const Vec<V>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class V>
HWY_INLINE V largest(const Vec<V>& a) {
  return hn::Max(hn::Abs(a.x), hn::Max(hn::Abs(a.y), hn::Abs(a.z)));
}

/// Lanes whose triangles are certainly apart, and certainly `crossing`. Neither: unsure.
template <class D>
struct PairMasks {
  hn::Mask<D> no, crossing;
};

/// Which of three values are certainly above and below zero.
template <class D>
struct Signs {
  using M = hn::Mask<D>;
  M above[3], below[3];

  template <class V>
  HWY_INLINE Signs(const V& s0, const V& s1, const V& s2, const V& bound, const V& minus_bound) {
    const V s[3] = {s0, s1, s2};
    for (int i = 0; i < 3; ++i) above[i] = hn::Gt(s[i], bound), below[i] = hn::Lt(s[i], minus_bound);
  }
  HWY_INLINE M all_above() const { return hn::And(above[0], hn::And(above[1], above[2])); }
  HWY_INLINE M all_below() const { return hn::And(below[0], hn::And(below[1], below[2])); }
  /// Whether all but some are on one side.
  HWY_INLINE M on_one_side_but(const M but[3]) const {
    const auto all = [&](const M values[3]) HWY_ATTR {
      return hn::And(hn::Or(values[0], but[0]), hn::And(hn::Or(values[1], but[1]), hn::Or(values[2], but[2])));
    };
    return hn::Or(all(above), all(below));
  }
  HWY_INLINE M any_above() const { return hn::Or(above[0], hn::Or(above[1], above[2])); }
  HWY_INLINE M any_below() const { return hn::Or(below[0], hn::Or(below[1], below[2])); }
};

/// Corners that both triangles of a lane have.
template <class D>
struct CommonMasks {
  hn::Mask<D> a[3], b[3];
};

/// Two triangles a lane, by the signs of their fifteen orient3d determinants (Guigue and Devillers 2003), each a sum of
/// ten that are computed. `a` and `b` hold the three vertices, each coordinate within `error` of the exact one.
///
/// With u the unit roundoff, P, Q, R at least the largest coordinates of three differences of vertices, and each
/// coordinate of them off by at most h = 2 error + u S, S = La + Lb + W, where La and Lb are those of the edges used
/// and W that of w = b0 - a0:
///   det(p, q, r) is off by at most 6 h (PQ + QR + RP) from its inputs, where P, Q, R are taken larger by h, and by
///   29 u PQR from its arithmetic, fused or not (a cross product 4.01 u PQ a coordinate, the dot product the rest).
///   A side of A's plane is a sum of two, det(a1, a2, w) and det(a1, a2, f): together they are off by at most
///   12 h La S + 35 u La² (W + Lb) <= La q, with q = S (24 error + 48 u S).
///   An edge against an edge is a sum of at most eight: four with (La, Lb, W), two with (La, Lb, Lb), two with
///   (La, La, Lb): 24 h (La + Lb) S + 71 u (La + Lb)² S <= 2 (La + Lb) q.
/// The factors below are rounded up by enough for the arithmetic of the bounds. What underflows is less than `tiny`.
///
/// With `common`, `no` says that the two share nothing outside of the convex hull of the common corners: so it is where
/// all other corners of one are strictly on one side of the other's plane, which then holds no more of the one than
/// that hull.
template <class D, class V = hn::Vec<D>>
HWY_INLINE PairMasks<D> test_pairs(D d, const Vec<V> a[3], const Vec<V> b[3], V error,
                                   const CommonMasks<D>* common = nullptr) {
  using T = hn::TFromD<D>;
  constexpr T u = std::numeric_limits<T>::epsilon() / 2;
  constexpr T tiny = sizeof(T) == 4 ? T{0x1p-120} : T{0};  // doubles in the exact domain do not underflow

  const Vec<V> a1 = a[1] - a[0], a2 = a[2] - a[0], f1 = b[1] - b[0], f2 = b[2] - b[0], w = b[0] - a[0];
  V La = hn::Max(largest(a1), largest(a2)), Lb = hn::Max(largest(f1), largest(f2));
  V S = hn::Add(hn::Add(La, Lb), largest(w));
  const V h = hn::MulAdd(hn::Set(d, T{2.125}), error, hn::Mul(hn::Set(d, T{1.125} * u), S));
  La = hn::Add(La, h), Lb = hn::Add(Lb, h), S = hn::MulAdd(hn::Set(d, T{3}), h, S);
  const V q = hn::Mul(S, hn::MulAdd(hn::Set(d, T{24.5}), error, hn::Mul(hn::Set(d, T{49} * u), S)));
  const V bound_a = hn::MulAdd(La, q, hn::Set(d, tiny)), bound_b = hn::MulAdd(Lb, q, hn::Set(d, tiny));
  const V bound_e = hn::MulAdd(hn::Add(hn::Add(La, Lb), hn::Add(La, Lb)), q, hn::Set(d, tiny));

  // Sides of B's vertices of A's plane and the other way round.
  const Vec<V> na = cross(a1, a2), nb = cross(f1, f2);
  const V p1 = dot(na, f1), p2 = dot(na, f2), r1 = dot(nb, a1), r2 = dot(nb, a2);
  const V d0 = dot(na, w), e0 = hn::Neg(dot(nb, w));
  const V minus_a = hn::Neg(bound_a), minus_b = hn::Neg(bound_b), minus_e = hn::Neg(bound_e);
  const Signs<D> sides_b(d0, hn::Add(d0, p1), hn::Add(d0, p2), bound_a, minus_a);
  const Signs<D> sides_a(e0, hn::Add(e0, r1), hn::Add(e0, r2), bound_b, minus_b);

  // Edges against edges, both triangles' in cyclic order: rows are A's edges 01, 12, 20, columns B's.
  const Vec<V> g1 = cross(f1, w), g2 = cross(f2, w);
  const V x11 = dot(a1, g1), x12 = dot(a1, g2), x21 = dot(a2, g1), x22 = dot(a2, g2);
  const V y1 = hn::Sub(hn::Sub(x21, x11), p1), y2 = hn::Sub(hn::Sub(x22, x12), p2);
  const Signs<D> rows[3] = {Signs<D>(x11, hn::Sub(hn::Sub(x12, x11), r1), hn::Neg(x12), bound_e, minus_e),
                            Signs<D>(y1, hn::Sub(hn::Sub(y2, y1), hn::Sub(r2, r1)), hn::Neg(y2), bound_e, minus_e),
                            Signs<D>(hn::Neg(x21), hn::Sub(hn::Sub(x21, x22), hn::Neg(r2)), x22, bound_e, minus_e)};

  // An edge certainly misses a triangle if both its ends are certainly on one side of the plane, or if its line passes
  // two of the triangle's edges on certainly different sides; it certainly passes through the interior if its ends are
  // on different sides and its line passes all three edges on the same. All six missing means apart, for an edge of one
  // meets the other wherever two triangles do, degenerate ones included: a sign other than 0 proves what it is about
  // to be proper.
  hn::Mask<D> all_miss = hn::Ge(La, La), some_pierces = hn::Lt(La, La);
  const auto see_edge = [&](const Signs<D>& ends, int i, int j, auto above0, auto above1, auto above2, auto below0,
                            auto below1, auto below2) HWY_ATTR {
    const auto any_above = hn::Or(above0, hn::Or(above1, above2)), any_below = hn::Or(below0, hn::Or(below1, below2));
    const auto all_above = hn::And(above0, hn::And(above1, above2)),
               all_below = hn::And(below0, hn::And(below1, below2));
    const auto same = hn::Or(hn::And(ends.above[i], ends.above[j]), hn::And(ends.below[i], ends.below[j]));
    const auto opposite = hn::Or(hn::And(ends.above[i], ends.below[j]), hn::And(ends.below[i], ends.above[j]));
    all_miss = hn::And(all_miss, hn::Or(same, hn::And(any_above, any_below)));
    some_pierces = hn::Or(some_pierces, hn::And(opposite, hn::Or(all_above, all_below)));
  };
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    see_edge(sides_a, i, j, rows[i].above[0], rows[i].above[1], rows[i].above[2], rows[i].below[0], rows[i].below[1],
             rows[i].below[2]);
    see_edge(sides_b, i, j, rows[0].above[i], rows[1].above[i], rows[2].above[i], rows[0].below[i], rows[1].below[i],
             rows[2].below[i]);
  }
  const auto a_proper = hn::Or(sides_b.any_above(), sides_b.any_below());
  const auto b_proper = hn::Or(sides_a.any_above(), sides_a.any_below());
  const auto one_side =
      common != nullptr
          ? hn::Or(sides_a.on_one_side_but(common->a), sides_b.on_one_side_but(common->b))
          : hn::Or(hn::Or(sides_a.all_above(), sides_a.all_below()), hn::Or(sides_b.all_above(), sides_b.all_below()));
  return {hn::Or(all_miss, one_side), hn::And(some_pierces, hn::And(a_proper, b_proper))};
}

}  // namespace impinge::narrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // IMPINGE_TRIANGLE_PAIR_INL
