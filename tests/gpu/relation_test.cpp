// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// How one frame lies in another, as a device works it out, against the bounds that shaders/frames.glsl derives.
#include "gpu/relation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "scenes/motion.hpp"
#include "shaders/frames.comp.h"
#include "tests/core/support.hpp"
#include "tests/gpu/ask.hpp"

namespace impinge {
namespace {

using Real = long double;

struct FrameCase {
  gpu::DeviceFrame a, b;
  gpu::DeviceRelation trees;
};
using Found = std::array<float, 12>;

void part(Real x, float& hi, float& lo) {
  hi = static_cast<float>(x);
  lo = static_cast<float>(x - Real{hi});
}

gpu::DeviceFrame any_frame(scenes::Random& random) {
  gpu::DeviceFrame frame{};
  const auto axes = scenes::random_rotation(random);
  for (std::size_t k = 0; k < 9; ++k) frame.axes[k] = static_cast<float>(axes[k]);
  for (std::size_t k = 0; k < 3; ++k) part(random.uniform(-1, 1), frame.origin_hi[k], frame.origin_lo[k]);
  return frame;
}

/// Origins that lie `near` from each other once B is where it is: what is left of numbers of about 1.
FrameCase any_case(scenes::Random& random, double near, int scale) {
  FrameCase made{any_frame(random), any_frame(random), {}};
  const auto m = scenes::stretched_rotation(random);
  made.trees.scale = std::ldexp(1.0f, scale);
  for (std::size_t i = 0; i < 3; ++i) {
    Real t = Real{made.a.origin_hi[i]} + Real{made.a.origin_lo[i]} + random.uniform(-near, near);
    for (std::size_t k = 0; k < 3; ++k) {
      part(m[3 * i + k], made.trees.m_hi[3 * i + k], made.trees.m_lo[3 * i + k]);
      t -= Real{m[3 * i + k]} * std::ldexp(Real{made.b.origin_hi[k]} + Real{made.b.origin_lo[k]}, scale);
    }
    part(t, made.trees.t_hi[i], made.trees.t_lo[i]);
  }
  return made;
}

TEST(DeviceRelation, IsWithinItsBounds) {
  test::Seeded seeded(21);
  std::vector<FrameCase> cases;
  for (const double near : {1.0, 0x1p-8, 0x1p-16, 0x1p-30, 0.0})
    for (const int scale : {0, -1, -10, -40})
      for (int i = 0; i < (test::is_smaller_set() ? 320 : 3200); ++i)
        cases.push_back(any_case(seeded.random, near, scale));
  const std::vector<Found> found = test::ask<Found>(shader_frames_comp, cases);
  constexpr Real u = 0x1p-23L;
  Real worst_C = 0, worst_c = 0;
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const auto& [a, b, trees] = cases[n];
    const auto m = [&](std::size_t i, std::size_t k) {
      return Real{trees.m_hi[3 * i + k]} + Real{trees.m_lo[3 * i + k]};
    };
    std::array<Real, 3> offset{};
    Real magnitude = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Real t = Real{trees.t_hi[i]} + Real{trees.t_lo[i]}, from = Real{a.origin_hi[i]} + Real{a.origin_lo[i]};
      offset[i] = t - from;
      Real sum = std::abs(t) + std::abs(from);
      for (std::size_t k = 0; k < 3; ++k) {
        const Real term = m(i, k) * Real{trees.scale} * (Real{b.origin_hi[k]} + Real{b.origin_lo[k]});
        offset[i] += term, sum += std::abs(term);
      }
      magnitude = std::max(magnitude, sum);
    }
    std::array<Real, 3> c{};
    Real far = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t l = 0; l < 3; ++l) c[i] += Real{a.axes[3 * l + i]} * offset[l];
      far = std::max(far, std::abs(c[i]));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        Real C = 0;
        for (std::size_t l = 0; l < 3; ++l)
          for (std::size_t q = 0; q < 3; ++q) C += Real{a.axes[3 * l + i]} * m(l, q) * Real{b.axes[3 * q + k]};
        worst_C = std::max(worst_C, std::abs(C - Real{found[n][3 * i + k]}) / (10 * u));
      }
      const Real bound = 9 * u * far + 1.75L * 0x1p-37L * magnitude;  // sqrt 3 of the offsets' error, rotated
      worst_c = std::max(worst_c, std::abs(c[i] - Real{found[n][9 + i]}) / bound);
    }
  }
  std::cout << "of the bounds, " << static_cast<double>(worst_C) << " are used for C and "
            << static_cast<double>(worst_c) << " for c\n";
  EXPECT_LE(worst_C, 1);
  EXPECT_LE(worst_c, 1);
  EXPECT_GT(worst_C, 0.05);  // and the cases do reach for them
}

/// What the CPU makes of two trees' relation for the device.
TEST(DeviceRelation, RefusesWhatItsBoundsWereNotMadeFor) {
  hierarchy::TreeRelation near{};
  for (int i = 0; i < 3; ++i) near.rows[i][i] = near.scaled_columns[i][i] = 1;
  near.scale = 1, near.error = 0x1p-40, near.defect = 1e-6;
  const gpu::TreeExtent extent{{0, 0, 0}, 2};
  const auto made = gpu::device_relation(near, extent, extent);
  ASSERT_TRUE(made);
  EXPECT_GE(made->error, 0x1p-40);
  EXPECT_GE(made->defect, 1e-6f);
  auto far = near;
  far.t[1] = 100;
  EXPECT_FALSE(gpu::device_relation(far, extent, extent));
  far = near, far.t[2] = std::nan("");
  EXPECT_FALSE(gpu::device_relation(far, extent, extent));
  EXPECT_FALSE(gpu::device_relation(near, {{0, 0, 0}, 1000}, extent));
  far = near, far.error = 1000;
  EXPECT_FALSE(gpu::device_relation(far, extent, extent));
}

}  // namespace
}  // namespace impinge
