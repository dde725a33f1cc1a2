// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "narrow/pair_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <span>

#include "scenes/random.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/core/support.hpp"
#include "tests/narrow/filter_attacks.hpp"

/// The certified filter attacked at its border: triangles that touch in a point or all but do, stored as far from where
/// they are as the stream's error allows, in the direction that deceives most.
namespace impinge {
namespace {

using partition::PairStream;
using namespace test::filter;
using scenes::Random;

void put(const Pair& pair, std::size_t lane, PairStream& stream) {
  for (std::size_t vertex = 0; vertex < 3; ++vertex)
    for (std::size_t i = 0; i < 3; ++i) {
      stream.a[3 * vertex + i][lane] = pair.a[vertex][i];
      stream.b[3 * vertex + i][lane] = pair.b[vertex][i];
    }
  stream.error[lane] = pair.error;
  stream.id_a[lane] = static_cast<std::uint32_t>(lane), stream.id_b[lane] = static_cast<std::uint32_t>(1000 + lane);
}

/// A triangle through another's middle, far from the filter's border.
Pair plain_crossing() {
  return {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{0.2f, 0.2f, -1}, {0.3f, 0.2f, 1}, {0.2f, 0.4f, 1}}}, 0};
}

/// The verdicts on pairs that fill one stream; what lies beyond them in it must not be seen.
std::vector<Said> verdicts(const std::vector<Pair>& pairs) {
  const auto stream = std::make_unique<PairStream>();
  EXPECT_LE(pairs.size(), PairStream::kCapacity);
  for (std::size_t i = 0; i < PairStream::kCapacity; ++i)
    put(i < pairs.size() ? pairs[i] : plain_crossing(), i, *stream);
  stream->size = pairs.size();
  narrow::Filtered filtered;
  filtered.crossing.push_back({7, 7}), filtered.unsure.push_back({8, 8});
  narrow::filter_pairs(*stream, filtered);
  EXPECT_EQ(filtered.crossing[0], (TrianglePair{7, 7}));
  EXPECT_EQ(filtered.unsure[0], (TrianglePair{8, 8}));
  std::vector<Said> found(pairs.size(), Said::no);
  const auto take = [&](const std::vector<TrianglePair>& list, Said verdict) {
    for (std::size_t i = 1; i < list.size(); ++i) {
      ASSERT_LT(list[i].a, pairs.size());
      ASSERT_EQ(list[i].b, 1000 + list[i].a);
      ASSERT_EQ(found[list[i].a], Said::no) << "one pair twice";
      found[list[i].a] = verdict;
    }
  };
  take(filtered.crossing, Said::crossing);
  take(filtered.unsure, Said::unsure);
  return found;
}

/// Fails where a verdict is not true of the exact triangles.
void expect_true(const std::vector<Attack>& attacks, Counts& counts) {
  for (std::size_t begin = 0; begin < attacks.size(); begin += PairStream::kCapacity) {
    const std::span some(attacks.data() + begin, std::min(attacks.size() - begin, PairStream::kCapacity));
    std::vector<Pair> pairs;
    for (const Attack& one : some) pairs.push_back(one.pair);
    ASSERT_NO_FATAL_FAILURE(expect_true(some, verdicts(pairs), counts));
  }
}

void attack(double scale, double off, const AnyPair& any, int rounds, Counts& counts, double finer = 1) {
  const std::vector<Attack> attacks = attacks_of(scale, off, any, rounds, finer);
  for (const std::int64_t set : test::instruction_sets()) {
    SCOPED_TRACE("scale " + std::to_string(scale));
    const test::OnInstructionSet on(set);
    ASSERT_NO_FATAL_FAILURE(expect_true(attacks, counts));
  }
}

TEST(PairFilter, IsRightAtItsBorder) {
  Counts counts;
  for (const double off : {0.0, 64.0 * 1024, 0x1p20})
    ASSERT_NO_FATAL_FAILURE(attack(1, off, border_pair, 20000, counts));
  for (const double scale : {0x1p-10, 1.0 / 3, 0x1p8})
    ASSERT_NO_FATAL_FAILURE(attack(scale, 0, border_pair, 6000, counts));
  std::cout << counts.of[0] << " no, " << counts.of[1] << " unsure, " << counts.of[2] << " crossing\n";
  for (const int n : counts.of) EXPECT_GT(n, 20000);
}

/// Where products vanish, vertices are denormal, and the tiny of the bounds is all that is left.
TEST(PairFilter, IsRightOfTinyTriangles) {
  Counts counts;
  for (const int exponent : {-30, -45, -50, -60, -100, -140, -150, -155})
    ASSERT_NO_FATAL_FAILURE(attack(std::ldexp(1.0, exponent), 0, border_pair, 1500, counts));
  EXPECT_GT(counts.of[1], 20000);
}

/// One triangle tiny beside the other.
TEST(PairFilter, IsRightOfTrianglesOfDifferentSizes) {
  for (const int exponent : {-3, -8, -15, -30, -60}) {
    Counts counts;
    const double small = std::ldexp(1.0, exponent);
    const AnyPair pair = border_pair_of_sizes(small);
    ASSERT_NO_FATAL_FAILURE(attack(1, 0, pair, 20000, counts));
    ASSERT_NO_FATAL_FAILURE(attack(1, 0, pair, 6000, counts, small));
    EXPECT_GT(counts.of[1], 10000);
  }
}

TEST(PairFilter, IsRightOfTrianglesFarApart) {
  Counts counts;
  const auto far = [](Random& random) {
    auto [a, b] = border_pair(random);
    const double by = std::ldexp(1.0, random.integer(10, 30));
    for (Point& p : b) p.x += by;
    return std::pair{a, b};
  };
  ASSERT_NO_FATAL_FAILURE(attack(1, 0, far, 3000, counts));
  EXPECT_GT(counts.of[0], 10000);
}

/// Long thin triangles that pass each other closely: the determinants cancel most.
TEST(PairFilter, IsRightOfSlivers) {
  Counts counts;
  const auto sliver = [](Random& random) {
    const Triangle t = lattice_triangle(random, 16);
    return Triangle{t[0], t[1], moved(between(t[0], t[1], random.integer(-2, 10)), lattice(random, 0))};
  };
  const auto pair = [&](Random& random) {
    Triangle a = sliver(random), b = sliver(random);
    const double thin = std::ldexp(1.0, -random.integer(0, 20));
    for (double* x : {&a[2].x, &b[2].y}) *x += thin * random.integer(-2, 2);
    const Point at = between(a[0], a[1], random.integer(0, 8)), from = between(b[0], b[1], random.integer(0, 8));
    for (Point& p : b) p = {p.x + (at.x - from.x), p.y + (at.y - from.y), p.z + (at.z - from.z) + thin / 4};
    return std::pair{a, b};
  };
  ASSERT_NO_FATAL_FAILURE(attack(1, 0, pair, 20000, counts));
  ASSERT_NO_FATAL_FAILURE(attack(1.0 / 3, 0, pair, 3000, counts));
  for (const int n : counts.of) EXPECT_GT(n, 100);
}

// --- use
// ----------------------------------------------------------------------------------------------------------------

Stored any_triangle(Random& random, double size) {
  const std::array<double, 3> center{random.unit(), random.unit(), random.unit()};
  Stored t;
  for (auto& vertex : t)
    for (std::size_t i = 0; i < 3; ++i) vertex[i] = static_cast<float>(center[i] + random.uniform(-size, size));
  return t;
}

/// A filter that never decided would be right as well. Errors as leaves have them: 2^-22 of the extent.
TEST(PairFilter, IsSeldomUnsureInGeneralPosition) {
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    for (const double size : {0.05, 0.2, 0.5}) {
      Random random(1);
      std::array<int, 3> count{};
      for (int block = 0; block < 100; ++block) {
        std::vector<Pair> pairs;
        for (std::size_t i = 0; i < PairStream::kCapacity; ++i)
          pairs.push_back({any_triangle(random, size), any_triangle(random, size), 0x1p-22f});
        for (const Said verdict : verdicts(pairs)) ++count[static_cast<std::size_t>(verdict)];
      }
      EXPECT_LT(count[static_cast<std::size_t>(Said::unsure)], 51200 / 1000) << "size " << size;
      if (size > 0.1) {
        EXPECT_GT(count[static_cast<std::size_t>(Said::crossing)], 51200 / 200);
      }
    }
  }
}

/// What is nearly flat, and near: where a filter loses its certainty first.
TEST(PairFilter, IsNotUnsureOfAllThatIsNear) {
  Random random(2);
  std::array<int, 3> count{};
  for (int block = 0; block < 20; ++block) {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < PairStream::kCapacity; ++i) {
      Pair pair{any_triangle(random, 0.3), any_triangle(random, 0.3), 0x1p-22f};
      for (auto& vertex : pair.a) vertex[2] *= 0x1p-10f;
      for (auto& vertex : pair.b) vertex[2] = vertex[2] * 0x1p-10f + 0x1p-9f;
      pairs.push_back(pair);
    }
    for (const Said verdict : verdicts(pairs)) ++count[static_cast<std::size_t>(verdict)];
  }
  EXPECT_LT(count[static_cast<std::size_t>(Said::unsure)], 20 * 512 / 20);
}

/// A pair's verdict is its own: the same alone, in every lane, in streams of every length.
TEST(PairFilter, SeesEachPairByItself) {
  Random random(3);
  std::vector<Pair> kinds{plain_crossing()};
  Pair apart = plain_crossing(), touching = plain_crossing();
  for (auto& vertex : apart.b) vertex[2] += 3;
  for (auto& vertex : touching.b) vertex[2] += 1;
  kinds.push_back(apart), kinds.push_back(touching);
  constexpr std::array kExpected{Said::crossing, Said::no, Said::unsure};
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    EXPECT_TRUE(verdicts({}).empty());
    for (std::size_t length = 1; length <= PairStream::kCapacity; length += length < 40 ? 1 : 59) {
      std::vector<Pair> pairs;
      std::vector<Said> expected;
      for (std::size_t i = 0; i < length; ++i) {
        const auto kind = static_cast<std::size_t>(random.integer(0, 2));
        pairs.push_back(kinds[kind]);
        expected.push_back(kExpected[kind]);
      }
      ASSERT_EQ(verdicts(pairs), expected) << length;
    }
  }
}

/// Numbers as an unused lane has them, and errors that leave nothing certain.
TEST(PairFilter, DecidesNothingOfWhatIsNotKnown) {
  std::vector<Pair> pairs;
  for (const float error : {1.0f, 100.0f, 1e10f, 1e30f, HUGE_VALF}) {
    Pair pair = plain_crossing();
    pair.error = error;
    pairs.push_back(pair);
  }
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    EXPECT_EQ(verdicts(pairs), std::vector<Said>(pairs.size(), Said::unsure));
  }
}

}  // namespace
}  // namespace impinge
