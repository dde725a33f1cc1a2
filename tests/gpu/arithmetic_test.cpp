// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// What a device's arithmetic is trusted for: the trials that it must pass, and the certified filter at its border.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iostream>

#include "gpu/probe.hpp"
#include "shaders/pairs.comp.h"
#include "shaders/pairs_doubles.comp.h"
#include "tests/gpu/ask.hpp"
#include "tests/narrow/filter_attacks.hpp"

namespace impinge {
namespace {

using namespace test::filter;

// --- the trials
// ---------------------------------------------------------------------------------------------------------

/// What an arithmetic of IEEE 754 answers.
std::vector<gpu::ProbeAnswer> right_answers(const std::vector<gpu::ProbeCase>& cases) {
  std::vector<gpu::ProbeAnswer> answers;
  for (const auto& [x] : cases) {
    const float sum = x[0] + x[1], product = x[0] * x[1];
    const double long_sum = double{x[0]} + double{x[1]};
    const double long_product = (double{x[0]} + double{x[2]}) * (double{x[1]} + double{x[3]});
    const auto high = static_cast<float>(long_product);
    answers.push_back({{sum, x[0] - x[1], product, product - x[2], sum, static_cast<float>(long_sum - double{sum}),
                        high, static_cast<float>(long_product - double{high}), std::max(x[0], x[1]), std::abs(x[0])},
                       x[0] > x[1],
                       x[0] > std::abs(x[1])    ? 1
                       : x[0] < -std::abs(x[1]) ? -1
                                                : 0});
  }
  return answers;
}

TEST(Probe, FindsNothingWrongWithIeee754) {
  const auto cases = gpu::probe_cases();
  EXPECT_EQ(gpu::judge(cases, right_answers(cases)), "");
}

/// Each liberty that a device might take is noticed.
TEST(Probe, FindsEveryFault) {
  const auto cases = gpu::probe_cases();
  const auto with = [&](const auto& change) {
    auto answers = right_answers(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) change(cases[i].x, answers[i]);
    return gpu::judge(cases, answers);
  };
  const auto two_off = [](float x) { return std::nextafter(std::nextafter(x, 1e30f), 1e30f); };
  EXPECT_NE(with([&](auto&, auto& a) { a.x[0] = two_off(a.x[0]); }).find("sum"), std::string::npos);
  EXPECT_NE(with([&](auto&, auto& a) { a.x[1] = two_off(a.x[1]); }).find("difference"), std::string::npos);
  EXPECT_NE(with([&](auto&, auto& a) { a.x[2] = two_off(a.x[2]); }).find("product"), std::string::npos);
  EXPECT_NE(with([](auto& x, auto& a) { a.x[3] = std::fma(x[0], x[1], -x[2]); }).find("fuses"), std::string::npos);
  EXPECT_NE(with([](auto&, auto& a) { a.x[5] = 0; }).find("sum of two"), std::string::npos);
  EXPECT_NE(with([](auto&, auto& a) { a.x[7] = 0; }).find("product of two"), std::string::npos);
  EXPECT_NE(with([](auto& x, auto& a) { a.x[8] = std::min(x[0], x[1]); }), "");
  EXPECT_NE(with([](auto& x, auto& a) { a.x[9] = x[0]; }), "");
  EXPECT_NE(with([](auto&, auto& a) { a.above ^= 1; }), "");
  EXPECT_NE(with([](auto&, auto& a) { a.sign = -a.sign; }), "");
  // Half precision, as "relaxed" arithmetic has it.
  EXPECT_NE(with([](auto&, auto& a) { a.x[2] = std::ldexp(std::round(std::ldexp(a.x[2], 10)), -10); }), "");
}

/// What a device may do: round either way, and take for nothing what is below 2^-126.
TEST(Probe, AllowsEveryDirectionOfRoundingAndNoDenormals) {
  const auto cases = gpu::probe_cases();
  for (const float towards : {-1e30f, 1e30f}) {
    auto answers = right_answers(cases);
    const auto flushed = [](float x) { return std::abs(x) < 0x1p-126f ? 0.0f : x; };
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const double x = cases[i].x[0], y = cases[i].x[1];
      const auto directed = [&](float nearest, double exact) {
        const bool is_beyond = towards > 0 ? double{nearest} < exact : double{nearest} > exact;
        return flushed(is_beyond ? std::nextafter(nearest, towards) : nearest);
      };
      answers[i].x[0] = directed(answers[i].x[0], x + y);
      answers[i].x[1] = directed(answers[i].x[1], x - y);
      answers[i].x[2] = directed(answers[i].x[2], x * y);
    }
    EXPECT_EQ(gpu::judge(cases, answers), "");
  }
}

/// What an arithmetic of IEEE 754 answers.
std::vector<gpu::DoubleAnswer> right_answers(const std::vector<gpu::DoubleCase>& cases) {
  std::vector<gpu::DoubleAnswer> answers;
  for (const auto& [x] : cases) {
    const double sum = x[0] + x[1], bound = std::abs(x[1]);
    answers.push_back(
        {{sum, x[0] - x[1], x[0] * x[1], x[0] * x[1] - x[2], x[1] - (sum - x[0]), std::max(x[0], x[1]), std::abs(x[0])},
         x[0] > x[1],
         int{x[0] > bound} - int{x[0] < -bound}});
  }
  return answers;
}

TEST(ProbeOfDoubles, FindsNothingWrongWithIeee754) {
  const auto cases = gpu::double_cases();
  EXPECT_EQ(gpu::judge(cases, right_answers(cases)), "");
}

TEST(ProbeOfDoubles, FindsEveryFault) {
  const auto cases = gpu::double_cases();
  const auto with = [&](const auto& change) {
    auto answers = right_answers(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) change(cases[i].x, answers[i]);
    return gpu::judge(cases, answers);
  };
  const auto two_off = [](double x) { return std::nextafter(std::nextafter(x, 1e300), 1e300); };
  EXPECT_NE(with([&](auto&, auto& a) { a.x[0] = two_off(a.x[0]); }).find("sum"), std::string::npos);
  EXPECT_NE(with([&](auto&, auto& a) { a.x[1] = two_off(a.x[1]); }).find("difference"), std::string::npos);
  EXPECT_NE(with([&](auto&, auto& a) { a.x[2] = two_off(a.x[2]); }).find("product"), std::string::npos);
  EXPECT_NE(with([](auto& x, auto& a) { a.x[3] = std::fma(x[0], x[1], -x[2]); }).find("fuses"), std::string::npos);
  EXPECT_NE(with([](auto&, auto& a) { a.x[4] = 0; }).find("leaves over"), std::string::npos);
  EXPECT_NE(with([](auto& x, auto& a) { a.x[5] = std::min(x[0], x[1]); }), "");
  EXPECT_NE(with([](auto& x, auto& a) { a.x[6] = x[0]; }), "");
  EXPECT_NE(with([](auto&, auto& a) { a.above ^= 1; }), "");
  EXPECT_NE(with([](auto&, auto& a) { a.sign = -a.sign; }), "");
  // Floats under the name of doubles.
  EXPECT_NE(with([](auto&, auto& a) { a.x[2] = static_cast<float>(a.x[2]); }), "");
}

TEST(ProbeOfDoubles, IsPassedByTheDevice) {
  const auto opened = gpu::Devices::of_process().choose("").opened;
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->with_doubles, opened->device.physical().has_doubles);
  if (!opened->device.physical().has_doubles) GTEST_SKIP();
  EXPECT_EQ(gpu::probe_doubles(opened->device), "");
}

// --- the filter
// ---------------------------------------------------------------------------------------------------------

template <class T>
std::vector<Said> verdicts(const std::vector<AttackAs<T>>& attacks) {
  struct StoredPair {
    T a[9], b[9], error;
  };
  std::span<const std::uint32_t> shader = shader_pairs_comp;
  if constexpr (std::is_same_v<T, double>) shader = shader_pairs_doubles_comp;
  constexpr std::size_t kSize = 9 * sizeof(T);
  std::vector<StoredPair> pairs(attacks.size());
  for (std::size_t i = 0; i < attacks.size(); ++i) {
    std::memcpy(pairs[i].a, &attacks[i].pair.a, kSize);
    std::memcpy(pairs[i].b, &attacks[i].pair.b, kSize);
    pairs[i].error = attacks[i].pair.error;
  }
  constexpr std::array kMeaning{Said::no, Said::crossing, Said::unsure};  // as in triangle_pair.glsl
  std::vector<Said> found;
  for (const std::uint32_t verdict : test::ask<std::uint32_t>(shader, pairs)) found.push_back(kMeaning.at(verdict));
  return found;
}

int rounds(int wanted) { return test::is_smaller_set() ? wanted / 8 : wanted; }

void attack(double scale, double off, const AnyPair& any, int wanted, Counts& counts, double finer = 1) {
  SCOPED_TRACE("scale " + std::to_string(scale));
  const std::vector<Attack> attacks = attacks_of(scale, off, any, rounds(wanted), finer);
  expect_true(attacks, verdicts(attacks), counts);
}

TEST(DeviceFilter, IsRightAtItsBorder) {
  Counts counts;
  for (const double off : {0.0, 64.0 * 1024, 0x1p20})
    ASSERT_NO_FATAL_FAILURE(attack(1, off, border_pair, 12000, counts));
  for (const double scale : {0x1p-20, 0x1p-10, 1.0 / 3, 0x1p8})
    ASSERT_NO_FATAL_FAILURE(attack(scale, 0, border_pair, 6000, counts));
  std::cout << counts.of[0] << " no, " << counts.of[1] << " unsure, " << counts.of[2] << " crossing\n";
  for (const int n : counts.of) EXPECT_GT(n, rounds(8000));
}

/// Where products vanish, vertices are denormal, and the tiny of the bounds is all that is left.
TEST(DeviceFilter, IsRightOfTinyTriangles) {
  Counts counts;
  for (const int exponent : {-30, -45, -50, -60, -100, -140, -150, -155})
    ASSERT_NO_FATAL_FAILURE(attack(std::ldexp(1.0, exponent), 0, border_pair, 1500, counts));
  EXPECT_GT(counts.of[1], rounds(20000));
}

TEST(DeviceFilter, IsRightOfTrianglesOfDifferentSizes) {
  for (const int exponent : {-3, -8, -15, -30, -60}) {
    Counts counts;
    const double small = std::ldexp(1.0, exponent);
    const AnyPair pair = border_pair_of_sizes(small);
    ASSERT_NO_FATAL_FAILURE(attack(1, 0, pair, 4000, counts));
    ASSERT_NO_FATAL_FAILURE(attack(1, 0, pair, 2000, counts, small));
    EXPECT_GT(counts.of[1], rounds(2000));
  }
}

/// Coordinates of at most 1, as in a scaled world: near its middle, and far from it.
TEST(DeviceFilter, IsRightAtItsBorderInDoubles) {
  if (!gpu::Devices::of_process().choose("").opened->with_doubles) GTEST_SKIP();
  for (const double off : {0.0, 0x1p25})
    for (const double finer : {1.0, 0x1p-8}) {
      Counts counts;
      const auto attacks = attacks_of<double>(0x1p-26, off, border_pair, 4000, finer);
      ASSERT_NO_FATAL_FAILURE(expect_true(attacks, verdicts(attacks), counts));
      std::cout << "apart " << counts.of[0] << ", unsure " << counts.of[1] << ", crossing " << counts.of[2] << '\n';
      for (const int count : counts.of) EXPECT_GT(count, 1000);
    }
}

/// A filter that never decided would be right as well. Errors as leaves have them on a device: 2^-18 of the extent.
TEST(DeviceFilter, IsSeldomUnsureInGeneralPosition) {
  Random random(1);
  std::vector<Attack> pairs(static_cast<std::size_t>(rounds(50'000)));
  const auto any_triangle = [&] {
    const std::array<double, 3> center{random.unit(), random.unit(), random.unit()};
    Stored t;
    for (auto& vertex : t)
      for (std::size_t i = 0; i < 3; ++i) vertex[i] = static_cast<float>(center[i] + random.uniform(-0.4, 0.4));
    return t;
  };
  for (Attack& pair : pairs) pair.pair = {any_triangle(), any_triangle(), 0x1p-18f};
  std::array<std::size_t, 3> count{};
  for (const Said verdict : verdicts(pairs)) ++count[static_cast<std::size_t>(verdict)];
  std::cout << "unsure of " << count[1] << " of " << pairs.size() << " pairs in general position\n";
  EXPECT_LT(count[static_cast<std::size_t>(Said::unsure)], pairs.size() / 200);
  EXPECT_GT(count[static_cast<std::size_t>(Said::crossing)], pairs.size() / 200);
}

}  // namespace
}  // namespace impinge
