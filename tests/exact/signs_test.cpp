// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/shapes.hpp"
#include "exact/integers.hpp"
#include "exact/pair_block.hpp"
#include "pairs.hpp"
#include "scenes/motion.hpp"
#include "tests/core/instruction_sets.hpp"

/// What each form of arithmetic says by itself: it may be silent, never wrong.
namespace impinge {
namespace {

using exact::IntVec;
using exact::PairBlock;
using exact::PairSigns;
using scenes::Random;
using test::Pair;

constexpr std::size_t kLanes = PairBlock::kLanes;

/// What is true of a pair, in the bits of PairSigns; both triangles' axes of a normal that is not zero.
struct Truth {
  PairSigns signs;
  std::array<std::array<bool, 4>, 2> normal{};
  bool boxes_apart = false;
};

Truth truth_of(const Pair& pair) {
  using oracle::operator-;
  Truth truth;
  for (int v = 0; v < 6; ++v) {
    const Triangle& plane = pair[v < 3 ? 1 : 0];
    const int side = test::side_of(plane[0], plane[1], plane[2], pair[v / 3][v % 3]);
    truth.signs.set(PairSigns::side_bit(side > 0   ? PairSigns::kAbove
                                        : side < 0 ? PairSigns::kBelow
                                                   : PairSigns::kOn,
                                        v / 3, v % 3),
                    1);
  }
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) truth.signs.set(PairSigns::kShared + 3 * a + b, unsigned{pair[0][a] == pair[1][b]});
  for (std::size_t t = 0; t < 2; ++t) {
    const auto o = points::exact(pair[t][0]);
    const auto n = oracle::cross(points::exact(pair[t][1]) - o, points::exact(pair[t][2]) - o);
    truth.normal[t] = {true, n[0] != 0, n[1] != 0, n[2] != 0};
  }
  truth.boxes_apart = !overlap(box_of(pair[0]), box_of(pair[1]));
  return truth;
}

void fill(PairBlock& block, std::size_t lane, const Pair& pair) {
  for (std::size_t i = 0; i < 6; ++i) {
    const Point& p = pair[i / 3][i % 3];
    block.rows[3 * i][lane] = p.x, block.rows[3 * i + 1][lane] = p.y, block.rows[3 * i + 2][lane] = p.z;
  }
}

/// An axis's integers are its coordinates times one power of two, and below 2^60.
bool are_integers_of(const PairBlock& block, std::size_t lane, std::size_t axis) {
  int shift = 0;
  for (std::size_t row = axis; row < 18; row += 3) {
    const double x = block.rows[row][lane];
    const auto q = block.integers[row][lane];
    if ((x == 0) != (q == 0) || std::abs(q) >= std::int64_t{1} << 60) return false;
    if (q != 0) shift = std::ilogb(static_cast<double>(q)) - std::ilogb(x);
  }
  for (std::size_t row = axis; row < 18; row += 3)
    if (mpq_class(std::ldexp(block.rows[row][lane], shift)) !=
        mpq_class(static_cast<double>(block.integers[row][lane])))
      return false;
  return true;
}

class See : public testing::TestWithParam<test::PairFamily> {
 protected:
  static constexpr std::uint64_t kSeed = 77;
  static constexpr int kBlocks = 250;

  void expect_true(const PairBlock& block, std::size_t lane, const Truth& truth, const Pair& pair) {
    const PairSigns signs = block.signs[lane];
    constexpr std::uint64_t kClaims = (std::uint64_t{1} << PairSigns::kNormal) - 1;
    constexpr std::uint64_t kBeyond = std::uint64_t{7} << PairSigns::kAbove;
    const std::uint64_t wrong = signs.bits & kClaims & ~truth.signs.bits & ~(truth.boxes_apart ? kBeyond : 0);
    ASSERT_EQ(wrong, 0u) << test::written(pair);
    ASSERT_EQ(signs.shared(), truth.signs.shared()) << test::written(pair);
    ASSERT_EQ(truth.boxes_apart && signs.position(0) != exact::Position::beyond, false) << test::written(pair);
    for (std::size_t t = 0; t < 2; ++t)
      ASSERT_TRUE(truth.normal[t][signs.normal(static_cast<int>(t))]) << test::written(pair);
    if (signs.get(PairSigns::kFits, 1) == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_TRUE(are_integers_of(block, lane, axis)) << test::written(pair);
  }

  Random random_{kSeed};
  testing::ScopedTrace trace_{__FILE__, __LINE__, "seed " + std::to_string(kSeed)};
};

TEST_P(See, SaysNothingThatIsNotTrue) {
  for (int i = 0; i < kBlocks; ++i) {
    std::array<Pair, kLanes> pairs;
    std::array<Truth, kLanes> truths;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      pairs[lane] = test::varied(GetParam().make(random_), random_);
      truths[lane] = truth_of(pairs[lane]);
    }
    for (const std::int64_t set : test::instruction_sets()) {
      const test::OnInstructionSet on(set);
      PairBlock block;
      for (std::size_t lane = 0; lane < kLanes; ++lane) fill(block, lane, pairs[lane]);
      exact::compute_signs(block);
      for (std::size_t lane = 0; lane < kLanes; ++lane) expect_true(block, lane, truths[lane], pairs[lane]);
    }
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, See, testing::ValuesIn(test::pair_families()), test::family_name);

/// Contract 1.1, bit for bit. The order of its sums shows in the last bits, and so does a product that is not rounded.
TEST(Place, IsWorldVertex) {
  Random random(9);
  for (int round = 0; round < 300; ++round) {
    const double size = std::ldexp(1.0, random.integer(-300, 250));
    std::array<std::vector<Vec3>, 2> meshes;
    std::array<Pose, 2> poses;
    for (std::size_t t = 0; t < 2; ++t) {
      for (int i = 0; i < 30; ++i) {
        const double x = random.uniform(-size, size), y = random.uniform(-size, size);
        meshes[t].push_back({x, y, random.uniform(-size, size)});
      }
      poses[t] = {.R = scenes::stretched_rotation(random), .t = scenes::random_motion(random, 10 * size).t};
    }
    PairBlock block;
    std::array<std::array<Point, kLanes>, 6> expected;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const int vertex = random.integer(0, 29);
        block.offsets[i][lane] = 3 * vertex;
        expected[i][lane] = world_vertex(poses[i / 3], meshes[i / 3][vertex]);
      }
    for (const std::int64_t set : test::instruction_sets()) {
      const test::OnInstructionSet on(set);
      exact::place(block, meshes[0].data(), poses[0], meshes[1].data(), poses[1]);
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t lane = 0; lane < kLanes; ++lane)
          ASSERT_EQ((Point{block.rows[3 * i][lane], block.rows[3 * i + 1][lane], block.rows[3 * i + 2][lane]}),
                    expected[i][lane]);
    }
  }
}

/// Lattices small enough need nothing but floating point, whatever scales their axes have; diagonal planes too.
TEST(See, KnowsAllSidesOnSmallLattices) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const auto source = points::integers(-1000, 1000);
    const Point o = source(random), u = source(random), v = source(random);
    Pair pair;
    for (Triangle& t : pair)
      for (Point& p : t)
        p = o + static_cast<double>(random.integer(-4, 4)) * u + static_cast<double>(random.integer(-4, 4)) * v;
    PairBlock block;
    for (std::size_t lane = 0; lane < kLanes; ++lane) fill(block, lane, test::varied(pair, random));
    exact::compute_signs(block);
    for (const PairSigns& signs : block.signs) {
      if (signs.position(0) == exact::Position::beyond) continue;  // apart
      ASSERT_EQ(signs.on(0) & signs.on(1), 7u) << test::written(pair);
    }
  }
}

/// Noise in the last bits of what was in one plane is told from nothing in twice the precision.
TEST(See, TellsTheNoiseOfAMotion) {
  Random random(6);
  int open = 0;
  for (int i = 0; i < 1000; ++i) {
    const Pose pose = scenes::random_motion(random, 10);
    PairBlock block;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const auto point = [&] { return world_vertex(pose, {random.unit(), random.unit(), 0}); };
      const Point a = point(), b = point(), c = point(), d = point(), e = point();
      fill(block, lane, {Triangle{a, b, c}, Triangle{d, e, point()}});
    }
    exact::compute_signs(block);
    for (const PairSigns& signs : block.signs)
      for (const int t : {0, 1}) open += signs.position(t) == exact::Position::unknown ? 1 : 0;
  }
  EXPECT_LT(open, 100) << "of 16000";  // the determinant is a multiple of 2^-53 cubed, and may be 0
}

constexpr std::int64_t kMost = (std::int64_t{1} << 60) - 1;

oracle::Vec exactly(const IntVec& v) {
  const auto rational = [](std::int64_t x) { return mpq_class(static_cast<long>(x)); };
  return {rational(v.x), rational(v.y), rational(v.z)};
}

/// Coordinates at the ends of the range and next to each other, so that products are as large as they get and their
/// sums cancel down to the last bit.
TEST(Integers, HaveTheSignsOfRationals) {
  using oracle::operator-;
  Random random(8);
  std::array<int, 3> seen{};
  for (int i = 0; i < 200000; ++i) {
    const auto number = [&]() -> std::int64_t {
      const std::int64_t small = random.integer(-2, 2);
      switch (random.integer(0, 5)) {
        case 0:
          return -kMost + 2 + small;
        case 1:
          return kMost - 2 + small;
        case 2:
          return (std::int64_t{1} << random.integer(0, 59)) + small;
        case 3:
          return static_cast<std::int64_t>(random.bits()) >> 4;
        default:
          return small;
      }
    };
    const auto point = [&] {
      const std::int64_t x = number(), y = number();
      return IntVec{x, y, number()};
    };
    const IntVec a = point(), b = point(), c = point();
    IntVec d = point();
    if (random.integer(0, 1) == 0) d = {b.x + c.x - a.x, b.y + c.y - a.y, b.z + c.z - a.z + random.integer(-1, 1)};
    if (std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) > kMost) continue;
    const auto o = exactly(a);
    const int expected = sgn(oracle::dot(oracle::cross(exactly(b) - o, exactly(c) - o), exactly(d) - o));
    ++seen[static_cast<std::size_t>(expected + 1)];
    ASSERT_EQ(exact::orient3d(a, b, c, d), expected);
    ASSERT_EQ(exact::orient3d(a, b, c, b), 0);
    const mpq_class flat = (exactly(a)[0] - exactly(c)[0]) * (exactly(b)[1] - exactly(c)[1]) -
                           (exactly(a)[1] - exactly(c)[1]) * (exactly(b)[0] - exactly(c)[0]);
    ASSERT_EQ(exact::orient2d(a.x, a.y, b.x, b.y, c.x, c.y), sgn(flat));
  }
  for (const int n : seen) EXPECT_GT(n, 10000);
}

/// 60 bits fit and 61 do not, on each axis by itself.
TEST(Integers, AreMadeOfSixtyBits) {
  std::array<IntVec, 2> q;
  const double high = 0x1.8p59;
  for (const double scale : {1.0, 0x1p240, 0x1p-358}) {
    for (const double low : {1.0, 0.5, 0.25, -1.0, -0.5})
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<double, 3> x{0, 0, 0}, y{0, 0, 0};
        x[axis] = scale * high, y[axis] = scale * low;
        if (std::abs(y[axis]) < 0x1p-358) continue;
        const bool fits = exact::to_integers(std::array{Point{x[0], x[1], x[2]}, Point{y[0], y[1], y[2]}}, q.data());
        EXPECT_EQ(fits, std::abs(low) == 1) << low << " on axis " << axis;
        if (!fits) continue;
        const std::array<std::int64_t, 3> qx{q[0].x, q[0].y, q[0].z}, qy{q[1].x, q[1].y, q[1].z};
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_EQ(qx[i], i == axis ? std::int64_t{3} << 58 : 0);
          EXPECT_EQ(qy[i], i == axis ? static_cast<std::int64_t>(low) : 0);
        }
      }
  }
  // Outside of the domain nothing fits, and nothing is done that is not defined.
  for (const double x : {0x1p301, 0x1p-359, 0x1p-1074, 0x1p1023, HUGE_VAL})
    EXPECT_FALSE(exact::to_integers(std::array{Point{x, 0, 0}, Point{0, 0, 0}}, q.data())) << x;
}

}  // namespace
}  // namespace impinge
