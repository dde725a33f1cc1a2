// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

#include "core/vec3.hpp"
#include "hierarchy/arena.hpp"
#include "hierarchy/principal_axes.hpp"
#include "hierarchy/soup_sample.hpp"
#include "hierarchy/split_plan.hpp"
#include "scenes/motion.hpp"
#include "tests/core/support.hpp"

/// What a wide tree is made with.
namespace impinge {
namespace {

Mat3 axes_of(const Mat3& m) {
  float axes[3][4];
  hierarchy::principal_axes({m[0].x, m[1].y, m[2].z, m[0].y, m[1].z, m[0].z}, axes);
  Mat3 rows;
  for (std::size_t i = 0; i < 3; ++i) rows[i] = {axes[0][i], axes[1][i], axes[2][i]};
  return rows;
}

Mat3 diagonal(double x, double y, double z) { return {Vec3{x, 0, 0}, Vec3{0, y, 0}, Vec3{0, 0, z}}; }

void expect_orthonormal(const Mat3& rows) {
  const Mat3 product = rows * transpose(rows);
  for (std::size_t i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(component(product[i], j), i == static_cast<std::size_t>(j), 0x1p-22);
}

TEST(PrincipalAxes, ClearTheMatrixWhereEigenvaluesAreApart) {
  test::Seeded seeded(1);
  for (const double second : {0.5, 0.1, 1e-4, 1e-9, 0.0}) {
    for (const double third : {0.5, 0.1, 1e-4, 0.0})
      for (int i = 0; i < 50; ++i) {
        const Mat3 turn = to_mat3(scenes::random_rotation(seeded.random));
        const double scale = std::ldexp(1.0, seeded.random.integer(-60, 60));
        const Mat3 m = turn * diagonal(scale, scale * second, scale * second * third) * transpose(turn);
        const Mat3 rows = axes_of(m);
        expect_orthonormal(rows);
        const Mat3 cleared = rows * m * transpose(rows);
        for (const double x : {cleared[0].y, cleared[1].z, cleared[0].z})
          EXPECT_LE(std::abs(x), 2e-5 * scale) << second << ' ' << third;
      }
  }
}

TEST(PrincipalAxes, AreAxesWhateverTheMatrix) {
  for (const Mat3& m : {diagonal(0, 0, 0), diagonal(1, 1, 1), diagonal(-1, -1, -1), diagonal(0, 0, 1e-30),
                        diagonal(1, 1, 0), diagonal(0, 1, 1), Mat3{Vec3{1, 1, 1}, Vec3{1, 1, 1}, Vec3{1, 1, 1}}})
    expect_orthonormal(axes_of(m));
  test::Seeded seeded(2);
  for (int i = 0; i < 1000; ++i) {
    // As rounding leaves them: not quite without negative eigenvalues.
    const Vec3 v{seeded.random.unit(), seeded.random.unit(), seeded.random.unit()};
    Mat3 m{v.x * v, v.y * v, v.z * v};
    for (Vec3& row : m)
      row = row + 1e-7 * Vec3{seeded.random.uniform(-1, 1), seeded.random.uniform(-1, 1), seeded.random.uniform(-1, 1)};
    expect_orthonormal(axes_of(m));
  }
}

TEST(SoupSample, HasOneOfEachStretch) {
  for (const std::size_t n : {1u, 2u, 255u, 256u, 257u, 511u, 512u, 1000u, 123456u, 2147483647u}) {
    const hierarchy::SoupSample sample(n, 256);
    ASSERT_EQ(sample.size(), std::min<std::size_t>(n, 256));
    for (std::uint32_t i = 0; i < sample.size(); ++i) {
      const double stretch = static_cast<double>(n) / sample.size();
      EXPECT_GE(static_cast<double>(sample[i]), std::floor(i * stretch) - 1) << n;
      EXPECT_LT(static_cast<double>(sample[i]), (i + 1) * stretch) << n;
      EXPECT_LT(sample[i], n);
      if (n <= 256) {
        EXPECT_EQ(sample[i], i);
      }
      if (i > 0) {
        EXPECT_GT(sample[i], sample[i - 1]);
      }
    }
  }
}

TEST(LeafCount, RoundsUpToWholeLeaves) {
  for (std::uint32_t leaf_size = 1; leaf_size <= 256; ++leaf_size) {
    const hierarchy::LeafCount leaves(leaf_size);
    for (std::uint32_t count = 0; count <= 4096; ++count)
      ASSERT_EQ(leaves(count), std::ceil(static_cast<float>(count) / static_cast<float>(leaf_size)))
          << count << ' ' << leaf_size;
  }
  EXPECT_EQ(hierarchy::LeafCount()(1000), 1000);
}

TEST(Arena, HandsOutAlignedMemoryThatDoesNotOverlap) {
  hierarchy::Arena arena;
  EXPECT_EQ(arena.bytes(), 0u);
  std::vector<std::vector<std::pair<std::uintptr_t, std::size_t>>> pieces(4);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < pieces.size(); ++t)
    threads.emplace_back([&, t] {
      scenes::Random random(t);
      for (int i = 0; i < 2000; ++i) {
        const auto size = static_cast<std::size_t>(random.integer(1, i % 500 == 0 ? 1000000 : 3000));
        pieces[t].emplace_back(reinterpret_cast<std::uintptr_t>(arena.allocate(size)), size);
      }
    });
  for (std::thread& thread : threads) thread.join();
  std::vector<std::pair<std::uintptr_t, std::size_t>> all;
  std::size_t asked = 0;
  for (const auto& some : pieces) all.insert(all.end(), some.begin(), some.end());
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].first % hierarchy::Arena::kAlignment, 0u);
    if (i > 0) {
      EXPECT_LE(all[i - 1].first + all[i - 1].second, all[i].first);
    }
    asked += all[i].second;
  }
  EXPECT_GE(arena.bytes(), asked);
  EXPECT_LE(static_cast<double>(arena.bytes()), 1.4 * static_cast<double>(asked));
}

}  // namespace
}  // namespace impinge
