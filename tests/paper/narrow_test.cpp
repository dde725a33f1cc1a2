// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <string_view>

#include "paper/decide.hpp"
#include "paper/scalar.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "tests/paper/batches.hpp"

namespace impinge {
namespace {

using paper::Batch;
using paper::CandidatePair;
using paper::ElementTest;
using paper::Verdict;

std::uint32_t add_triangle(Batch& batch, const Triangle& t) {
  const auto first = static_cast<std::uint32_t>(batch.vertices.size());
  batch.vertices.insert(batch.vertices.end(), t.begin(), t.end());
  batch.triangles.push_back({first, first + 1, first + 2});
  return static_cast<std::uint32_t>(batch.triangles.size() - 1);
}

/// An edge against a triangle, alone.
Verdict verdict(const Segment& edge, const Triangle& t) {
  Batch batch;
  add_triangle(batch, t);
  batch.vertices.insert(batch.vertices.end(), edge.begin(), edge.end());
  batch.edges.push_back({3, 4});
  batch.tests.push_back({0, 0, ElementTest::kNone, ElementTest::kNone});
  std::vector<Verdict> verdicts;
  paper::test_edges(batch, verdicts);
  EXPECT_EQ(verdicts.size(), 1u);
  return verdicts[0];
}

/// What `crossing` claims: an end strictly on either side, the line strictly through the interior.
bool crosses(const Segment& edge, const Triangle& t) {
  if (orient3d(t[0], t[1], t[2], edge[0]) * orient3d(t[0], t[1], t[2], edge[1]) >= 0) return false;
  const int s = orient3d(edge[0], edge[1], t[0], t[1]);
  return s != 0 && s == orient3d(edge[0], edge[1], t[1], t[2]) && s == orient3d(edge[0], edge[1], t[2], t[0]);
}

/// False if the verdict contradicts exact arithmetic.
bool is_true(Verdict v, const Segment& edge, const Triangle& t) {
  if (v == Verdict::no) return !intersects(edge, t);
  return v == Verdict::unsure || crosses(edge, t);
}

/// Integers, some of them an ulp off, at a scale and an offset. Zero stays: its neighbours lie outside the domain.
rc::Gen<Point> point(double scale, double offset) {
  const auto coordinate =
      rc::gen::map(rc::gen::pair(rc::gen::inRange(-3, 4), rc::gen::inRange(-1, 2)), [=](const std::pair<int, int>& p) {
        const double x = scale * (p.first + offset);
        return p.second == 0 || x == 0 ? x : std::nextafter(x, p.second * HUGE_VAL);
      });
  return rc::gen::map(rc::gen::tuple(coordinate, coordinate, coordinate), [](const auto& c) {
    return Point{std::get<0>(c), std::get<1>(c), std::get<2>(c)};
  });
}

RC_GTEST_PROP(Scalar, NeverContradictsExactArithmetic, ()) {
  const double scale = *rc::gen::element(1.0, 0x1p-70, 0x1p60, 0x1p-300, 0x1p290, 1.0 / 3);
  const double offset = *rc::gen::element(0.0, 0.1, 1e6);
  const auto any = point(scale, offset);
  const Segment edge{*any, *any};
  const Triangle t{*any, *any, *any};
  RC_ASSERT(is_true(verdict(edge, t), edge, t));
}

/// Where differences are the least that the domain has, and their products the least that there are.
RC_GTEST_PROP(Scalar, NeverContradictsExactArithmeticAtTheDomainsBottom, ()) {
  const auto coordinate = rc::gen::map(rc::gen::inRange(-3, 4), [](int i) { return i * 0x1p-358; });
  const auto any = rc::gen::map(rc::gen::tuple(coordinate, coordinate, coordinate), [](const auto& c) {
    return Point{std::get<0>(c), std::get<1>(c), std::get<2>(c)};
  });
  const Segment edge{*any, *any};
  const Triangle t{*any, *any, *any};
  RC_ASSERT(is_true(verdict(edge, t), edge, t));
}

/// Edges through computed points of the triangle's border and interior, or ending on them, then nudged by ulps: the
/// filter's own border.
TEST(Scalar, NeverContradictsExactArithmeticAtTheFiltersBorder) {
  for (const double offset : {0.0, 1.0, 1e3, 1e6, 1e12}) {
    test::Seeded seeded(static_cast<std::uint64_t>(offset) + 1);
    scenes::Random& random = seeded.random;
    const auto around = [&] {
      return Point{offset + random.uniform(-1, 1), offset + random.uniform(-1, 1), offset + random.uniform(-1, 1)};
    };
    std::array<int, 3> count{};
    for (int i = 0; i < 6000; ++i) {
      const Triangle t{around(), around(), around()};
      const double u = i % 3 == 0 ? 0 : i % 3 == 1 ? random.unit() : 1e-15 * random.unit(), v = (1 - u) * random.unit();
      Point p = (1 - u - v) * t[0] + u * t[1] + v * t[2];
      for (double* x : {&p.x, &p.y, &p.z})
        for (int k = random.integer(0, 2); k > 0; --k) *x = std::nextafter(*x, random.integer(0, 1) * 1e300);
      const Point q = around();
      const double beyond = std::array{0.0, 1.0, 1e-14}[static_cast<std::size_t>(random.integer(0, 2))];
      const Segment edge{q, p + beyond * (p - q)};
      const Verdict found = verdict(edge, t);
      ++count[static_cast<std::size_t>(found)];
      ASSERT_TRUE(is_true(found, edge, t)) << "case " << i << " at " << offset;
    }
    // Far from the origin an ulp is much more than the filter's error, which is relative to the differences.
    if (offset <= 1) {
      EXPECT_GT(count[static_cast<std::size_t>(Verdict::unsure)], 1000);
    }
    EXPECT_LT(count[static_cast<std::size_t>(Verdict::unsure)], 6000);
  }
}

TEST(Scalar, DecidesPlainCases) {
  const Triangle t{Point{0, 0, 0}, Point{4, 0, 0}, Point{0, 4, 0}};
  EXPECT_EQ(verdict({Point{1, 1, -1}, Point{1, 1, 1}}, t), Verdict::crossing);
  EXPECT_EQ(verdict({Point{1, 1, 1}, Point{1, 1, -1}}, t), Verdict::crossing);
  EXPECT_EQ(verdict({Point{1, 1, 1}, Point{1, 1, 2}}, t), Verdict::no);       // one side
  EXPECT_EQ(verdict({Point{3, 3, -1}, Point{3, 3, 1}}, t), Verdict::no);      // beside it
  EXPECT_EQ(verdict({Point{1, 1, 0}, Point{1, 1, 2}}, t), Verdict::unsure);   // ends on it
  EXPECT_EQ(verdict({Point{2, 0, -1}, Point{2, 0, 1}}, t), Verdict::unsure);  // through its edge
  EXPECT_EQ(verdict({Point{1, 1, 0}, Point{2, 1, 0}}, t), Verdict::unsure);   // in its plane
}

/// Folded verdicts of whole batches against the exact classification of each pair, and the exact stage's answer
/// against brute force.
void expect_true_batch(const test::LeavesOf& leaves, const std::vector<test::Contact>& expected) {
  const Batch batch = leaves.batch();
  std::vector<Verdict> tests{Verdict::crossing};
  paper::test_edges(batch, tests);
  ASSERT_EQ(tests.size(), batch.tests.size());
  std::vector<Verdict> pairs{Verdict::crossing};
  paper::fold(batch, tests, pairs);
  ASSERT_EQ(pairs.size(), batch.pairs.size());
  std::uint64_t unsure = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto exact = intersects(batch.triangle(batch.pairs[i].triangle_a), batch.triangle(batch.pairs[i].triangle_b));
    ASSERT_FALSE(pairs[i] == Verdict::no && exact);
    ASSERT_FALSE(pairs[i] == Verdict::crossing && exact != Kind::crossing);
    unsure += pairs[i] == Verdict::unsure;
  }
  std::vector<exact::Contact> contacts;
  EXPECT_EQ(paper::decide(batch, pairs, contacts), unsure);
  std::vector<test::Contact> found;
  for (const exact::Contact& c : contacts) found.push_back({0, 1, c.a, c.b, static_cast<std::uint32_t>(c.kind)});
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
}

TEST(Narrow, AgreesWithTheExactClassification) {
  test::Seeded seeded(1);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 32)) {
    SCOPED_TRACE(named.name);
    const test::LeavesOf leaves(named.scene, 8);
    expect_true_batch(leaves, test::brute_force(named.scene));
  }
}

/// `crossing` needs two proper triangles, which one edge through one triangle does not show.
TEST(Fold, IsUnsureOfACrossingByADegenerateTriangle) {
  const Triangle t{Point{0, 0, 0}, Point{4, 0, 0}, Point{0, 4, 0}};
  const Triangle proper{Point{1, 1, -1}, Point{1, 1, 1}, Point{3, 5, 0}}, segment{proper[0], proper[1], proper[0]};
  for (const auto& [other, expected] : {std::pair{proper, Verdict::crossing}, std::pair{segment, Verdict::unsure}}) {
    Batch batch;
    const std::uint32_t a = add_triangle(batch, t), b = add_triangle(batch, other);
    batch.edges.push_back({3, 4});
    batch.pairs.push_back({10, 20, a, b});
    batch.pairs.push_back({10, 21, a, b});
    batch.tests.push_back({0, a, 0, ElementTest::kNone});
    std::vector<Verdict> pairs;
    const std::array<Verdict, 1> tests{Verdict::crossing};
    paper::fold(batch, tests, pairs);
    EXPECT_EQ(pairs, (std::vector<Verdict>{expected, Verdict::no}));
    batch.pairs[0].triangle_a = b, batch.pairs[0].triangle_b = a;
    paper::fold(batch, tests, pairs);
    EXPECT_EQ(pairs[0], expected);
  }
}

TEST(Fold, TakesTheGreatestVerdictOfEachPairsTests) {
  const Triangle t{Point{0, 0, 0}, Point{4, 0, 0}, Point{0, 4, 0}};
  Batch batch;
  add_triangle(batch, t);
  for (std::uint32_t i = 0; i < 3; ++i) batch.pairs.push_back({i, i, 0, 0});
  batch.tests = {{0, 0, 0, ElementTest::kNone}, {1, 0, 0, 1}, {2, 0, 1, 2}, {3, 0, 2, ElementTest::kNone}};
  const std::array tests{Verdict::no, Verdict::unsure, Verdict::crossing, Verdict::no};
  std::vector<Verdict> pairs;
  paper::fold(batch, tests, pairs);
  EXPECT_EQ(pairs, (std::vector<Verdict>{Verdict::unsure, Verdict::crossing, Verdict::crossing}));
}

/// How often floating point cannot tell: printed, and held to a generous bound.
void expect_seldom_unsure(std::string_view backend, std::uint64_t one_in) {
  std::uint64_t pairs = 0, unsure = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Seeded seeded(seed);
    const auto soup = [&] { return scenes::triangle_soup(seeded.random, 400, 0.5); };
    scenes::PlacedScene scene = scenes::pair_scene(soup(), soup());
    for (auto& object : scene.objects) object.pose.R = scenes::random_rotation(seeded.random);
    const Mesh a = test::mesh_of(scene.meshes[0]), b = test::mesh_of(scene.meshes[1]);
    const Options options{.backend = backend};
    const Statistics s = collide(a, scene.objects[0].pose, b, scene.objects[1].pose, options).value().statistics;
    pairs += s.triangle_pairs;
    unsure += s.exact_calls;
  }
  std::cout << backend << ": unsure of " << unsure << " of " << pairs << " pairs of triangles\n";
  testing::Test::RecordProperty("pairs", std::to_string(pairs));
  testing::Test::RecordProperty("unsure", std::to_string(unsure));
  EXPECT_GT(pairs, 10000u);
  EXPECT_LT(unsure, pairs / one_in);
}

TEST(Narrow, IsSeldomUnsureInGeneralPosition) { expect_seldom_unsure("scalar", 1000); }
/// In single precision.
TEST(Narrow, IsSeldomUnsureInGeneralPositionWithManyAtATime) { expect_seldom_unsure("simd", 400); }

}  // namespace
}  // namespace impinge
