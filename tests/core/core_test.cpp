// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gmpxx.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cfenv>
#include <cmath>
#include <cstring>

#include "core/float_environment.hpp"
#include "core/hash.hpp"
#include "core/number.hpp"
#include "core/pose.hpp"
#include "scenes/motion.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

constexpr std::array kRoundings{FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

TEST(WorldVertex, RoundsEachProductAndEachSum) {
  Pose pose;
  pose.R[0] = 1 + 0x1p-30;
  pose.t[0] = -1;
  EXPECT_EQ(world_vertex(pose, {1 - 0x1p-30, 0, 0}).x, 0.0);  // fused it would be -2^-60
  pose.R = {1, 1, 1, 1, 1, 1, 1, 1, 1};
  pose.t = {0x1p-53, -1, 0};
  const Point v{1, 0x1p-53, 0x1p-53};  // each sum on its own rounds back to 1; in another order they add up
  EXPECT_EQ(world_vertex(pose, v), (Point{1, 0, 1}));
}

TEST(WorldVertex, IsTheSameInEveryRoundingMode) {
  scenes::Random random(7);
  for (int i = 0; i < 100; ++i) {
    const Pose pose = scenes::random_motion(random, 10);
    const Point v{random.unit(), random.unit(), random.unit()};
    const Point expected = world_vertex(pose, v);
    for (const int rounding : kRoundings) {
      const test::CallersMode mode(rounding, i % 2 == 0);
      EXPECT_EQ(expected, world_vertex(pose, v));
      EXPECT_TRUE(mode.is_untouched());
    }
  }
}

TEST(PoseVertices, AgreesWithWorldVertex) {
  test::Seeded seeded(1);
  const Pose pose = scenes::random_motion(seeded.random, 1e6);
  std::vector<Vec3> vertices;
  for (int i = 0; i < 50; ++i) vertices.push_back({seeded.random.unit(), seeded.random.unit(), seeded.random.unit()});
  const std::vector<std::uint32_t> indices{49, 0, 7, 7, 31};
  std::vector<Vec3> some(indices.size()), all = vertices;
  pose_vertices(pose, vertices, indices, some.data());
  pose_all_vertices(pose, all);
  for (std::size_t i = 0; i < indices.size(); ++i) EXPECT_EQ(some[i], world_vertex(pose, vertices[indices[i]]));
  for (std::size_t i = 0; i < vertices.size(); ++i) EXPECT_EQ(all[i], world_vertex(pose, vertices[i]));
}

/// 4.01 of the 16 u S are what a world vertex may be off; the rest is spoken for by other bounds.
TEST(RoundingRadius, HoldsTheErrorOfWorldVerticesFourTimes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    Pose pose = scenes::random_motion(random, std::ldexp(1.0, random.integer(-30, 30)));
    if (seed % 2 == 0) pose.R = scenes::stretched_rotation(random);
    scenes::MeshData numbers;
    for (int i = 0; i < 90; ++i) numbers.xyz.push_back(random.uniform(-1, 1) * std::ldexp(1.0, random.integer(-3, 0)));
    for (std::uint32_t i = 0; i < 30; ++i) numbers.triangles.push_back(i);
    const Mesh mesh = test::mesh_of(numbers);
    const Vec3 radius = rounding_radius(pose, test::numbers_of(mesh));
    for (const Point& v : mesh.vertices()) {
      const Point world = world_vertex(pose, v);
      for (int i = 0; i < 3; ++i) {
        const mpq_class exact = mpq_class(pose.R[3 * i]) * v.x + mpq_class(pose.R[3 * i + 1]) * v.y +
                                mpq_class(pose.R[3 * i + 2]) * v.z + mpq_class(pose.t[i]);
        const mpq_class error = abs(mpq_class(exact - component(world, i)));
        EXPECT_LE(error * 16, mpq_class(component(radius, i)) * 4.01);
      }
    }
  }
}

TEST(OrthogonalityDefect, IsWhatTheStretchIs) {
  test::Seeded seeded(3);
  for (const double off : {0.0, 1e-9, 9e-7, 1e-5}) {
    Pose pose;
    pose.R = scenes::stretched_rotation(seeded.random, off);
    EXPECT_NEAR(orthogonality_defect(pose), off, 1e-3 * off + 1e-15);
  }
}

RC_GTEST_PROP(Number, LowestBitAndExponentTakeANumberApart, (std::uint64_t bits)) {
  double x;
  std::memcpy(&x, &bits, sizeof x);
  RC_PRE(std::isfinite(x) && x != 0);
  const mpq_class value(abs(mpq_class(x)));
  const auto power = [](int e) { return e >= 0 ? mpq_class(mpz_class(1) << e) : mpq_class(1, mpz_class(1) << -e); };
  const mpq_class odd = value / power(lowest_bit(x));
  RC_ASSERT(odd.get_den() == 1 && mpz_odd_p(odd.get_num_mpz_t()));
  RC_ASSERT(value >= power(exponent(x)) && value < power(exponent(x) + 1));
}

/// Contract 1.3, taken by its words: world coordinates below 2^300 and multiples of 2^-358.
bool every_world_vertex_in_domain(const Mesh& mesh, const Pose& pose) {
  for (const Point& v : mesh.vertices()) {
    const Point w = world_vertex(pose, v);
    for (const double x : {w.x, w.y, w.z}) {
      if (x == 0) continue;
      const double multiple = std::ldexp(x, 358);
      if (std::abs(x) >= 0x1p300 || (std::abs(multiple) < 0x1p53 && multiple != std::floor(multiple))) return false;
    }
  }
  return true;
}

TEST(ExactDomain, IsThatOfTheContract) {
  int inside = 0, outside = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    const int top = seed % 2 == 0 ? random.integer(-359, -300) : random.integer(240, 300);
    scenes::MeshData numbers;
    for (int i = 0; i < 9; ++i)
      numbers.xyz.push_back(random.integer(-3, 3) == 0 ? 0 : std::ldexp(random.integer(-9, 9), top));
    if (seed % 3 == 0) numbers.xyz[seed % 9] = random.unit();
    numbers.triangles = {0, 1, 2};
    Pose pose;
    if (seed % 5 == 0) pose.R = scenes::random_rotation(random);
    if (seed % 7 == 0) pose.t[seed % 3] = std::ldexp(random.uniform(-1, 1), random.integer(-310, 301));
    const Mesh mesh = test::mesh_of(numbers);
    const bool expected = every_world_vertex_in_domain(mesh, pose);
    EXPECT_EQ(in_exact_domain(pose, test::numbers_of(mesh)), expected);
    ++(expected ? inside : outside);
  }
  EXPECT_GT(inside, 200);
  EXPECT_GT(outside, 200);
}

TEST(Hash, MixesAsSplitmix64) {
  // The first outputs of the published generator from seed 0.
  EXPECT_EQ(mix(0), 0xE220A8397B1DCDAFu);
  EXPECT_EQ(mix(0x9E3779B97F4A7C15u), 0x6E789E6AA1B965F4u);
  EXPECT_EQ(number_bits(-0.0), number_bits(0.0));
  EXPECT_EQ(number_bits(1.0), 0x3FF0000000000000u);
  EXPECT_NE(number_bits(-1.0), number_bits(1.0));
}

TEST(FloatEnvironment, IsNearestWithDenormalsAndRestoresTheCallers) {
  for (const int rounding : kRoundings)
    for (const bool flush : {false, true}) {
      const test::CallersMode mode(rounding, flush);
      EXPECT_EQ(test::rounds_to_nearest_with_denormals(), rounding == FE_TONEAREST && !flush);
      {
        const FloatEnvironment nearest;
        EXPECT_TRUE(test::rounds_to_nearest_with_denormals());
      }
      EXPECT_TRUE(mode.is_untouched());
    }
}

}  // namespace
}  // namespace impinge
