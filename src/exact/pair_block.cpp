// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/pair_block.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "exact/pair_block.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace impinge::exact::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, PairBlock::kLanes>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using Bits = hn::Rebind<std::uint64_t, D>;
using Integers = hn::Rebind<std::int64_t, D>;

struct Vec {
  V x, y, z;
};

HWY_INLINE Vec operator-(const Vec& a, const Vec& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vec absolute(const Vec& a) { return {hn::Abs(a.x), hn::Abs(a.y), hn::Abs(a.z)}; }
HWY_INLINE V dot(const Vec& a, const Vec& b) { return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x))); }
HWY_INLINE Vec cross(const Vec& a, const Vec& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
/// The sums of the absolute products in a cross product of vectors that are not negative.
HWY_INLINE Vec cross_magnitude(const Vec& a, const Vec& b) {
  return {hn::MulAdd(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulAdd(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulAdd(a.x, b.y, hn::Mul(a.y, b.x))};
}

/// A number as the rounded result of an operation and the error made by it (exact/expansion.hpp).
struct Twofold {
  V high, low;
};
struct TwofoldVec {
  Vec high, low;
};

HWY_INLINE Twofold two_sum(V a, V b) {
  const V sum = hn::Add(a, b), b_virtual = hn::Sub(sum, a), a_virtual = hn::Sub(sum, b_virtual);
  return {sum, hn::Add(hn::Sub(a, a_virtual), hn::Sub(b, b_virtual))};
}
HWY_INLINE Twofold two_difference(V a, V b) {
  const V difference = hn::Sub(a, b), b_virtual = hn::Sub(a, difference), a_virtual = hn::Add(difference, b_virtual);
  return {difference, hn::Add(hn::Sub(a, a_virtual), hn::Sub(b_virtual, b))};
}
#if HWY_NATIVE_FMA
HWY_INLINE Twofold two_product(V a, V b) {
  const V product = hn::Mul(a, b);
  return {product, hn::MulSub(a, b, product)};
}
#else
HWY_INLINE Twofold split(V a) {
  const V c = hn::Mul(hn::Set(D(), 134217729.0), a), high = hn::Sub(c, hn::Sub(c, a));
  return {high, hn::Sub(a, high)};
}
HWY_INLINE Twofold two_product(V a, V b) {
  const V product = hn::Mul(a, b);
  const Twofold p = split(a), q = split(b);
  const V error =
      hn::Sub(hn::Sub(hn::Sub(product, hn::Mul(p.high, q.high)), hn::Mul(p.low, q.high)), hn::Mul(p.high, q.low));
  return {product, hn::Sub(hn::Mul(p.low, q.low), error)};
}
#endif
HWY_INLINE TwofoldVec two_difference(const Vec& a, const Vec& b) {
  const Twofold x = two_difference(a.x, b.x), y = two_difference(a.y, b.y), z = two_difference(a.z, b.z);
  return {{x.high, y.high, z.high}, {x.low, y.low, z.low}};
}

/// a d - b c in twice the precision.
HWY_INLINE Twofold twofold_minor(Twofold a, Twofold b, Twofold c, Twofold d) {
  const Twofold p = two_product(a.high, d.high), q = two_product(b.high, c.high);
  const Twofold difference = two_difference(p.high, q.high);
  V low = hn::Add(difference.low, hn::Sub(p.low, q.low));
  low = hn::MulAdd(a.low, d.high, hn::MulAdd(a.high, d.low, low));
  low = hn::NegMulAdd(b.low, c.high, hn::NegMulAdd(b.high, c.low, low));
  return {difference.high, low};
}
HWY_INLINE TwofoldVec cross(const TwofoldVec& a, const TwofoldVec& b) {
  const Twofold ax{a.high.x, a.low.x}, ay{a.high.y, a.low.y}, az{a.high.z, a.low.z};
  const Twofold bx{b.high.x, b.low.x}, by{b.high.y, b.low.y}, bz{b.high.z, b.low.z};
  const Twofold x = twofold_minor(ay, az, by, bz), y = twofold_minor(az, ax, bz, bx), z = twofold_minor(ax, ay, bx, by);
  return {{x.high, y.high, z.high}, {x.low, y.low, z.low}};
}
HWY_INLINE V dot(const TwofoldVec& a, const TwofoldVec& b) {
  const Twofold x = two_product(a.high.x, b.high.x), y = two_product(a.high.y, b.high.y),
                z = two_product(a.high.z, b.high.z);
  const Twofold xy = two_sum(x.high, y.high);
  V low = hn::Add(hn::Add(hn::Add(x.low, y.low), z.low), xy.low);
  low = hn::MulAdd(a.high.z, b.low.z, hn::MulAdd(a.high.y, b.low.y, hn::MulAdd(a.high.x, b.low.x, low)));
  low = hn::MulAdd(a.low.z, b.high.z, hn::MulAdd(a.low.y, b.high.y, hn::MulAdd(a.low.x, b.high.x, low)));
  return hn::Add(hn::Add(xy.high, z.high), low);
}

// With eps = 2^-53, P the exact sum of the absolute products of a determinant of three differences, and arithmetic
// fused or not:
//   once: each product passes three differences, two products and at most three sums, so the determinant is off by at
//   most 8.1 eps P; the permanent as computed is at least (1 - 8.1 eps) P. 2^-49 is 16 eps.
//   A component of the normal passes two differences, a product and a sum: 4.1 eps. 2^-50 is 8 eps.
//   twice: with m the magnitude of a component of the normal, that component is off by eps^2 m for the products of two
//   lower halves left out, 16 eps^2 m for the sums of lower halves, which grow to 4 eps m, and 2 eps^2 m for the
//   products in them: 19 eps^2 m. Its product with the third difference adds 4 eps^2 P for lower halves left out and,
//   in the sum of lower halves, which grows to 7 eps P, 48 eps^2 P. The last two sums are off by eps of the result and
//   7 eps^2 P: 78 eps^2 P in all. 2^-99 is 128 eps^2.
// Nothing is lost to underflow, as in exact/filter.hpp: in the domain lower halves are multiples of 2^-1074 too.
constexpr double kOnceBound = 0x1p-49, kProperBound = 0x1p-50, kTwiceBound = 0x1p-99;

using SignLanes = hn::Vec<Bits>;

HWY_INLINE SignLanes where(M mask, std::uint64_t signs) {
  const Bits bits;
  return hn::IfThenElseZero(hn::RebindMask(bits, mask), hn::Set(bits, signs));
}
constexpr std::uint64_t side_bit(int side, int vertex) {
  return std::uint64_t{1} << PairSigns::side_bit(side, vertex / 3, vertex % 3);
}
constexpr std::uint64_t kAllCorners = 0b111000000111;  // both triangles', on one side

/// Lanes with a triangle strictly on one side.
HWY_INLINE M beyond(SignLanes signs) {
  const Bits bits;
  const auto all = [&](int first) HWY_ATTR {
    const auto corners = hn::Set(bits, std::uint64_t{7} << first);
    return hn::Eq(hn::And(signs, corners), corners);
  };
  const auto any =
      hn::Or(hn::Or(all(PairSigns::kAbove), all(PairSigns::kBelow)),
             hn::Or(all(PairSigns::kSides + PairSigns::kAbove), all(PairSigns::kSides + PairSigns::kBelow)));
  return hn::RebindMask(D(), any);
}

/// Lanes in which every side is known.
HWY_INLINE M all_known(SignLanes signs) {
  const Bits bits;
  const auto corners = hn::Set(bits, kAllCorners);
  const auto known =
      hn::Or(hn::Or(signs, hn::ShiftRight<PairSigns::kBelow>(signs)), hn::ShiftRight<PairSigns::kOn>(signs));
  return hn::RebindMask(D(), hn::Eq(hn::And(known, corners), corners));
}

HWY_INLINE M boxes_apart(const Vec* p) {
  const auto apart = [&](V Vec::*axis) HWY_ATTR {
    const V low_a = hn::Min(hn::Min(p[0].*axis, p[1].*axis), p[2].*axis);
    const V low_b = hn::Min(hn::Min(p[3].*axis, p[4].*axis), p[5].*axis);
    const V high_a = hn::Max(hn::Max(p[0].*axis, p[1].*axis), p[2].*axis);
    const V high_b = hn::Max(hn::Max(p[3].*axis, p[4].*axis), p[5].*axis);
    return hn::Or(hn::Lt(high_a, low_b), hn::Lt(high_b, low_a));
  };
  return hn::Or(hn::Or(apart(&Vec::x), apart(&Vec::y)), apart(&Vec::z));
}

/// Shared vertices are in both planes.
HWY_INLINE SignLanes find_shared_vertices(const Vec* p) {
  auto signs = hn::Zero(Bits());
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec &a = p[i], &b = p[3 + j];
      const M equal = hn::And(hn::Eq(a.x, b.x), hn::And(hn::Eq(a.y, b.y), hn::Eq(a.z, b.z)));
      signs = hn::Or(signs, where(equal, std::uint64_t{1} << (PairSigns::kShared + 3 * i + j) |
                                             side_bit(PairSigns::kOn, i) | side_bit(PairSigns::kOn, 3 + j)));
    }
  }
  return signs;
}

HWY_INLINE SignLanes side_of(int vertex, V determinant, V bound) {
  return hn::Or(where(hn::Gt(determinant, bound), side_bit(PairSigns::kAbove, vertex)),
                where(hn::Lt(determinant, hn::Neg(bound)), side_bit(PairSigns::kBelow, vertex)));
}

/// The sides of a triangle's vertices, and whether the other one is proper.
HWY_INLINE SignLanes see_sides(const Vec* p, int triangle, V* permanents) {
  const D d;
  const Vec* plane = triangle == 0 ? p + 3 : p;
  const Vec u = plane[1] - plane[0], v = plane[2] - plane[0];
  const Vec normal = cross(u, v), magnitude = cross_magnitude(absolute(u), absolute(v));
  const auto certain = [&](V Vec::*axis) HWY_ATTR {
    return hn::RebindMask(Bits(), hn::Gt(hn::Abs(normal.*axis), hn::Mul(hn::Set(d, kProperBound), magnitude.*axis)));
  };
  const auto axis = [&](std::uint64_t number)
                        HWY_ATTR { return hn::Set(Bits(), number << (PairSigns::kNormal + 2 * (1 - triangle))); };
  auto signs = hn::IfThenElseZero(certain(&Vec::z), axis(3));
  signs = hn::IfThenElse(certain(&Vec::y), axis(2), signs);
  signs = hn::IfThenElse(certain(&Vec::x), axis(1), signs);
  for (int i = 3 * triangle; i < 3 * triangle + 3; ++i) {
    const Vec w = p[i] - plane[0];
    permanents[i] = dot(absolute(w), magnitude);
    signs = hn::Or(signs, side_of(i, dot(w, normal), hn::Mul(hn::Set(d, kOnceBound), permanents[i])));
    signs = hn::Or(signs, where(hn::Eq(permanents[i], hn::Zero(d)), side_bit(PairSigns::kOn, i)));
  }
  return signs;
}

HWY_INLINE SignLanes see_sides_twofold(const Vec* p, int triangle, const V* permanents) {
  const Vec* plane = triangle == 0 ? p + 3 : p;
  const TwofoldVec normal = cross(two_difference(plane[1], plane[0]), two_difference(plane[2], plane[0]));
  auto signs = hn::Zero(Bits());
  for (int i = 3 * triangle; i < 3 * triangle + 3; ++i)
    signs = hn::Or(signs, side_of(i, dot(two_difference(p[i], plane[0]), normal),
                                  hn::Mul(hn::Set(D(), kTwiceBound), permanents[i])));
  return signs;
}

/// A vertex that comparisons place in a plane is on no side of it, whatever sign rounding has given it.
HWY_INLINE SignLanes without_those_on(SignLanes signs) {
  const auto on = hn::And(signs, hn::Set(Bits(), kAllCorners << PairSigns::kOn));
  return hn::AndNot(hn::Or(hn::ShiftRight<PairSigns::kOn>(on), hn::ShiftRight<PairSigns::kOn - PairSigns::kBelow>(on)),
                    signs);
}

/// Whether coordinates are multiples of one power of two on each axis and below 2^24 of it. Differences are then below
/// 2^25 of it, normals below 2^51, both without rounding, and twofold determinants are exact: those that are not
/// certainly positive or negative are zero (the bound is below one).
/// If (x + c) - c is x, with |x| <= 2^-30 c and 2^k <= c < 2^(k + 1), then x + c is at least 2^(k - 1) and rounded to a
/// multiple of 2^(k - 53), as c is one; hence so is x, and below 2^(k - 29).
HWY_INLINE M are_small_integers(const Vec* p) {
  const auto small = [&](V Vec::*axis) HWY_ATTR {
    V largest = hn::Abs(p[0].*axis);
    for (int i = 1; i < 6; ++i) largest = hn::Max(largest, hn::Abs(p[i].*axis));
    const V c = hn::Mul(hn::Set(D(), 0x1p30), largest);
    const auto fits = [&](int i) HWY_ATTR { return hn::Eq(hn::Sub(hn::Add(p[i].*axis, c), c), p[i].*axis); };
    return hn::And(hn::And(hn::And(fits(0), fits(1)), hn::And(fits(2), fits(3))), hn::And(fits(4), fits(5)));
  };
  return hn::And(hn::And(small(&Vec::x), small(&Vec::y)), small(&Vec::z));
}

/// As exact/integers.cpp does it. Tells where all fit.
HWY_INLINE M make_integers(PairBlock& block, std::size_t at) {
  const D d;
  const Bits bits;
  const Integers integers;
  const V upper = hn::Set(d, 0x1.8p82), lower = hn::Set(d, 0x1.8p52);
  const auto constants = hn::Add(hn::ShiftLeft<30>(hn::BitCast(bits, upper)), hn::BitCast(bits, lower));
  M fits = hn::Eq(hn::Zero(d), hn::Zero(d));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    V x[6], largest = hn::Zero(d);
    for (std::size_t i = 0; i < 6; ++i) {
      x[i] = hn::Load(d, block.rows[3 * i + axis] + at);
      largest = hn::Max(largest, hn::Abs(x[i]));
    }
    // Of zeros the scale does not matter: it is finite.
    const auto exponent = hn::ShiftRight<52>(hn::BitCast(bits, largest));
    const V scale = hn::BitCast(d, hn::ShiftLeft<52>(hn::Sub(hn::Set(bits, 2 * 1023 + 59), exponent)));
    for (std::size_t i = 0; i < 6; ++i) {
      // In two parts of 30 bits: added to, the constants leave just those in the significand's lower end.
      const V scaled = hn::Mul(scale, x[i]), shifted = hn::Add(scaled, upper),
              low = hn::Sub(scaled, hn::Sub(shifted, upper));
      const V low_shifted = hn::Add(low, lower);
      fits = hn::And(fits, hn::Eq(hn::Sub(low_shifted, lower), low));
      const auto integer = hn::Add(hn::ShiftLeft<30>(hn::BitCast(bits, shifted)), hn::BitCast(bits, low_shifted));
      hn::Store(hn::BitCast(integers, hn::Sub(integer, constants)), integers, block.integers[3 * i + axis] + at);
    }
  }
  return fits;
}

HWY_INLINE void compute_lane_signs(PairBlock& block, std::size_t at) {
  const D d;
  const Bits bits;
  Vec p[6];
  for (std::size_t i = 0; i < 6; ++i)
    p[i] = {hn::Load(d, block.rows[3 * i] + at), hn::Load(d, block.rows[3 * i + 1] + at),
            hn::Load(d, block.rows[3 * i + 2] + at)};
  V permanents[6];
  const M apart = boxes_apart(p);
  SignLanes signs = find_shared_vertices(p);
  const M shares = hn::RebindMask(
      d, hn::Ne(hn::And(signs, hn::Set(bits, std::uint64_t{511} << PairSigns::kShared)), hn::Zero(bits)));
  signs = without_those_on(hn::Or(signs, hn::Or(see_sides(p, 0, permanents), see_sides(p, 1, permanents))));

  const auto unclear = [&] HWY_ATTR { return hn::Not(hn::Or(all_known(signs), hn::Or(apart, beyond(signs)))); };
  if (!hn::AllFalse(d, unclear())) {
    signs = hn::Or(signs, hn::Or(see_sides_twofold(p, 0, permanents), see_sides_twofold(p, 1, permanents)));
    signs = without_those_on(signs);
  }
  if (!hn::AllFalse(d, unclear())) {
    const auto all_on = where(are_small_integers(p), kAllCorners << PairSigns::kOn);
    const auto off =
        hn::Or(hn::ShiftLeft<PairSigns::kOn>(signs), hn::ShiftLeft<PairSigns::kOn - PairSigns::kBelow>(signs));
    signs = hn::Or(signs, hn::AndNot(off, all_on));
  }
  const M open = hn::Not(hn::Or(hn::And(shares, all_known(signs)), hn::Or(apart, beyond(signs))));
  if (!hn::AllFalse(d, open))
    signs = hn::Or(signs, where(make_integers(block, at), std::uint64_t{1} << PairSigns::kFits));
  // Triangles whose boxes are apart count as beyond each other's plane.
  hn::Store(hn::Or(signs, where(apart, std::uint64_t{7} << PairSigns::kAbove)), bits, &block.signs[at].bits);
}

void compute_signs(PairBlock& block) {
  for (std::size_t at = 0; at < PairBlock::kLanes; at += hn::Lanes(D())) compute_lane_signs(block, at);
}

void place(PairBlock& block, const Vec3* vertices_a, const Pose& pose_a, const Vec3* vertices_b, const Pose& pose_b) {
  const D d;
  const Integers integers;
  for (std::size_t at = 0; at < PairBlock::kLanes; at += hn::Lanes(d)) {
    for (int i = 0; i < 6; ++i) {
      const Pose& pose = i < 3 ? pose_a : pose_b;
      const double* vertices = i < 3 ? &vertices_a->x : &vertices_b->x;
      const auto offset = hn::Load(integers, block.offsets[i] + at);
      const V x = hn::GatherIndex(d, vertices, offset), y = hn::GatherIndex(d, vertices + 1, offset),
              z = hn::GatherIndex(d, vertices + 2, offset);
      for (std::size_t r = 0; r < 3; ++r) {
        const auto term = [&](std::size_t k, V v) HWY_ATTR { return hn::Mul(hn::Set(d, pose.R[3 * r + k]), v); };
        const V turned = hn::Add(hn::Add(term(0, x), term(1, y)), term(2, z));
        hn::Store(hn::Add(turned, hn::Set(d, pose.t[r])), d, block.rows[3 * static_cast<std::size_t>(i) + r] + at);
      }
    }
  }
}

}  // namespace impinge::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::exact {

HWY_EXPORT(place);
HWY_EXPORT(compute_signs);

void place(PairBlock& block, const Vec3* vertices_a, const Pose& pose_a, const Vec3* vertices_b, const Pose& pose_b) {
  HWY_DYNAMIC_DISPATCH(place)(block, vertices_a, pose_a, vertices_b, pose_b);
}
void compute_signs(PairBlock& block) { HWY_DYNAMIC_DISPATCH(compute_signs)(block); }

}  // namespace impinge::exact
#endif
