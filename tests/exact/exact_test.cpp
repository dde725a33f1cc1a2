// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gmpxx.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/hash.hpp"
#include "core/number.hpp"
#include "exact/expansion.hpp"
#include "exact/orientation.hpp"
#include "exact/triangle_pair.hpp"
#include "impinge/predicates.hpp"
#include "paper/decide.hpp"

namespace impinge {
namespace {

using exact::Expansion;
using exact::Two;

/// Numbers of few bits that cancel and leave gaps, zeros, and numbers of all bits.
rc::Gen<double> number() {
  const auto sparse = rc::gen::map(rc::gen::tuple(rc::gen::inRange(-3, 4), rc::gen::inRange(-60, 60),
                                                  rc::gen::inRange(-60, 60), rc::gen::inRange(-2, 3)),
                                   [](const auto& t) {
                                     const auto [high, e, f, low] = t;
                                     return std::ldexp(high, e) + std::ldexp(low, f);
                                   });
  const auto dense = rc::gen::map(rc::gen::pair(rc::gen::arbitrary<std::int64_t>(), rc::gen::inRange(-60, 60)),
                                  [](const auto& p) { return std::ldexp(static_cast<double>(p.first), p.second); });
  // Small sizes make small integers: spread their bits.
  const auto spread =
      rc::gen::map(rc::gen::pair(rc::gen::arbitrary<std::uint32_t>(), rc::gen::inRange(-60, 60)), [](const auto& p) {
        const std::uint64_t bits = mix(p.first) >> 11;
        return std::ldexp(static_cast<double>(bits), p.second);
      });
  return rc::gen::oneOf(sparse, dense, spread);
}

mpq_class sum_of(const Two& t) { return mpq_class(t.high) + t.low; }

template <std::size_t N>
mpq_class value(const Expansion<N>& e) {
  mpq_class sum = 0;
  for (std::size_t i = 0; i < e.size; ++i) sum += e.component[i];
  return sum;
}

/// Components grow, are not zero, and each is beyond all bits of the one before; the sign is that of the sum.
template <std::size_t N>
void check(const Expansion<N>& e, const mpq_class& expected) {
  RC_ASSERT(value(e) == expected);
  RC_ASSERT(e.sign() == sgn(expected));
  RC_ASSERT(e.size <= N);
  for (std::size_t i = 0; i < e.size; ++i) {
    RC_ASSERT(e.component[i] != 0);
    if (i == 0) continue;
    const mpq_class lowest = mpq_class(std::ldexp(1.0, lowest_bit(e.component[i])));
    RC_ASSERT(abs(mpq_class(e.component[i - 1])) < lowest);
  }
}

RC_GTEST_PROP(Expansion, ArithmeticIsExact, ()) {
  const double a = *number(), b = *number(), c = *number(), d = *number();
  RC_ASSERT(sum_of(exact::two_sum(a, b)) == mpq_class(a) + b);
  RC_ASSERT(sum_of(exact::two_difference(a, b)) == mpq_class(a) - b);
  RC_ASSERT(sum_of(exact::two_product(a, b)) == mpq_class(a) * b);
  RC_ASSERT(exact::two_product(a, b).high == a * b);
  const Expansion<2> x = exact::expansion(exact::two_sum(a, b)), y = exact::expansion(exact::two_difference(c, d)),
                     z = exact::expansion(Two{d, 0});
  const mpq_class p = mpq_class(a) + b, q = mpq_class(c) - d;
  check(x, p);
  check(x + y, p + q);
  check(x - y, p - q);
  check(x - x, 0);
  check(x * z, p * d);
  check(x * y, p * q);
  check((x * y) * y, p * q * q);
  check(x * y + y * z, p * q + q * d);
  check((x * y - y * z) * x - (x - y), (p * q - q * d) * p - (p - q));
}

rc::Gen<Point> lattice_point(int reach) {
  const auto i = rc::gen::inRange(-reach, reach + 1);
  return rc::gen::map(rc::gen::tuple(i, i, i), [](const auto& t) {
    return Point{1.0 * std::get<0>(t), 1.0 * std::get<1>(t), 1.0 * std::get<2>(t)};
  });
}

Triangle any_triangle() {
  const auto p = lattice_point(2);
  return {*p, *p, *p};
}

Triangle permuted(const Triangle& t, int i) {
  constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  return {t[kOrders[i][0]], t[kOrders[i][1]], t[kOrders[i][2]]};
}

Triangle mapped(const Triangle& t, double scale, const Vec3& shift) {
  return {scale * t[0] + shift, scale * t[1] + shift, scale * t[2] + shift};
}

/// The order of the triangles and of their vertices is of no account, nor is a common scale or motion that rounds
/// nothing.
RC_GTEST_PROP(Classify, DependsOnThePointSetsAlone, ()) {
  const Triangle a = any_triangle(), b = any_triangle();
  const auto kind = exact::classify(a, b);
  const bool area = exact::share_area(a, b);
  for (int i = 0; i < 6; ++i) {
    const Triangle p = permuted(a, i), q = permuted(b, (5 * i + 2) % 6);
    RC_ASSERT(exact::classify(p, q) == kind);
    RC_ASSERT(exact::classify(q, p) == kind);
    RC_ASSERT(exact::share_area(p, q) == area && exact::share_area(q, p) == area);
  }
  for (const double scale : {0x1p-356, 0x1p-70, 0x1p60, 0x1p297}) {
    const Vec3 shift = scale * Vec3{3, -5, 7};
    RC_ASSERT(exact::classify(mapped(a, scale, shift), mapped(b, scale, shift)) == kind);
    RC_ASSERT(exact::share_area(mapped(a, scale, shift), mapped(b, scale, shift)) == area);
  }
  const Vec3 far{1e6, -2e6, 1 << 30};
  RC_ASSERT(exact::classify(mapped(a, 1, far), mapped(b, 1, far)) == kind);
  const auto turned = [](const Triangle& t) {
    const auto turn = [](const Point& p) { return Point{p.y, -p.x, p.z}; };
    return Triangle{turn(t[0]), turn(t[1]), turn(t[2])};
  };
  RC_ASSERT(exact::classify(turned(a), turned(b)) == kind);
}

/// A shared area makes a pair coplanar; a shared vertex makes it touch at least.
RC_GTEST_PROP(Classify, AgreesWithWhatIsKnownOfThePair, ()) {
  const Triangle a = any_triangle();
  Triangle b = any_triangle();
  if (exact::share_area(a, b)) RC_ASSERT(exact::classify(a, b) == Kind::coplanar);
  b[1] = a[2];
  RC_ASSERT(exact::classify(a, b).has_value());
  RC_ASSERT(exact::classify(a, b) != Kind::crossing || (!is_degenerate(a) && !is_degenerate(b)));
  RC_ASSERT(exact::classify(a, a) == (is_degenerate(a) ? Kind::touching : Kind::coplanar));
  RC_ASSERT(exact::share_area(a, a) == !is_degenerate(a));
}

TEST(Classify, PlainCases) {
  const Triangle t{Point{0, 0, 0}, Point{4, 0, 0}, Point{0, 4, 0}};
  const auto with = [&](const Triangle& other) { return exact::classify(t, other); };
  EXPECT_EQ(with({Point{1, 1, -1}, Point{1, 1, 1}, Point{9, 9, 0}}), Kind::crossing);
  EXPECT_EQ(with({Point{1, 1, 0}, Point{1, 1, 1}, Point{9, 9, 1}}), Kind::touching);    // a vertex on the inside
  EXPECT_EQ(with({Point{2, 0, -1}, Point{2, 0, 1}, Point{2, -2, 0}}), Kind::touching);  // edge through edge
  EXPECT_EQ(with({Point{4, 0, 0}, Point{0, 4, 0}, Point{4, 4, 0}}), Kind::coplanar);    // a common edge
  EXPECT_EQ(with({Point{4, 0, 0}, Point{0, 4, 0}, Point{4, 4, 0x1p-300}}), Kind::touching);
  EXPECT_EQ(with({Point{2, 2, 0x1p-300}, Point{2, 2, 1}, Point{4, 4, 1}}), std::nullopt);
  EXPECT_EQ(with({Point{1, 1, -1}, Point{1, 1, 1}, Point{1, 1, 0}}), Kind::touching);  // a segment through it
  EXPECT_EQ(with({Point{1, 1, 0}, Point{1, 1, 0}, Point{1, 1, 0}}), Kind::touching);   // a point on it
  EXPECT_EQ(with({Point{3, 3, 0}, Point{3, 3, 0}, Point{3, 3, 0}}), std::nullopt);
  EXPECT_FALSE(exact::share_area(t, {Point{4, 0, 0}, Point{0, 4, 0}, Point{4, 4, 0}}));
  EXPECT_TRUE(exact::share_area(t, {Point{3, 0, 0}, Point{0, 4, 0}, Point{4, 4, 0}}));
}

/// What the backends call certain is taken as it is, the rest decided here.
TEST(Decide, TrustsTheCertainAndDecidesTheUnsure) {
  using paper::Verdict;
  paper::Batch batch;
  batch.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 1}, {9, 9, 1}, {1, 1, 2}, {2, 2, 2}, {1, 2, 2}};
  batch.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  batch.pairs = {{10, 20, 0, 1}, {11, 21, 0, 2}, {12, 22, 0, 1}, {13, 23, 0, 2}, {14, 24, 0, 1}};
  const std::array verdicts{Verdict::unsure, Verdict::unsure, Verdict::crossing, Verdict::no, Verdict::no};
  std::vector<exact::Contact> contacts{{2, 3, Kind::coplanar}};
  EXPECT_EQ(paper::decide(batch, verdicts, contacts), 2u);
  ASSERT_EQ(contacts.size(), 3u);
  EXPECT_EQ(contacts[0].a, 2u);  // appended to
  const auto is = [](const exact::Contact& c, std::uint32_t a, std::uint32_t b, Kind kind) {
    return c.a == a && c.b == b && c.kind == kind;
  };
  EXPECT_TRUE(is(contacts[1], 10, 20, Kind::touching));
  EXPECT_TRUE(is(contacts[2], 12, 22, Kind::crossing));
}

}  // namespace
}  // namespace impinge
