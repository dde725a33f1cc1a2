// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Parts whose verdict is plain, in shapes that a tolerance could mistake: each as it is and after rigid motions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "impinge/clash.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::box;
using scenes::inverted;
using scenes::joined;
using scenes::MeshData;

Clash judged(const MeshData& a, const MeshData& b, const Pose& pose, std::optional<double> tolerance) {
  ClashOptions options;
  options.tolerance = tolerance;
  return judge(test::mesh_of(a), pose, test::mesh_of(b), pose, options).value();
}

void expect_verdict(Verdict verdict, const MeshData& a, const MeshData& b,
                    std::optional<double> tolerance = std::nullopt, std::optional<Note> note = std::nullopt) {
  for (std::uint64_t seed = 0; seed <= 4; ++seed) {
    test::Seeded seeded(seed);
    const Pose pose = seed == 0 ? Pose{} : scenes::random_motion(seeded.random, 10);
    for (const bool swap : {false, true}) {
      const Clash clash = swap ? judged(b, a, pose, tolerance) : judged(a, b, pose, tolerance);
      EXPECT_EQ(name(clash.verdict), name(verdict)) << "seed " << seed << ", " << sentence(clash.note);
      if (note) {
        EXPECT_EQ(sentence(clash.note), sentence(*note)) << "seed " << seed;
      }
    }
  }
}

MeshData disc(int sides, double low, double high) {
  scenes::Outline outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    outline.push_back({std::cos(angle), std::sin(angle)});
  }
  return scenes::prism(outline, low, high);
}

/// A plane of two triangles at x, with its normal to +x.
MeshData wall(double x, double low_z, double high_z) {
  return {{x, -1, low_z, x, 1, low_z, x, 1, high_z, x, -1, high_z}, {0, 1, 2, 0, 2, 3}};
}

TEST(Noise, OneShellOfManyIsShared) {
  const MeshData cube = box({0, 0, 0}, {1, 1, 1});
  expect_verdict(Verdict::penetrating, joined(cube, box({3, -0.2, -0.2}, {60, 1.2, 1.2})),
                 joined(cube, box({70, -0.2, -0.2}, {200, 1.2, 1.2})));
}

TEST(Noise, OneShellIsSharedAndAnotherFillsACavity) {
  const MeshData cube = box({0, 0, 0}, {1, 1, 1}), plug = box({5, 0, 0}, {6, 1, 1});
  expect_verdict(Verdict::penetrating, joined(cube, plug),
                 joined(cube, joined(box({4, -1, -1}, {7, 2, 2}), inverted(plug))));
}

TEST(Noise, OneFlushTriangleFacesHundreds) {
  const MeshData plate = box({-2, -2, -1}, {2, 2, 0});
  expect_verdict(Verdict::touching, plate, disc(400, 0, 1));
  expect_verdict(Verdict::touching, plate, box({-1, -1, 0}, {1, 1, 2}, 30));
  expect_verdict(Verdict::touching, plate, box({-1, -1, -0.09}, {1, 1, 2}, 25), 0.1);
  expect_verdict(Verdict::penetrating, plate, box({-1, -1, -0.11}, {1, 1, 2}, 25), 0.1);
}

TEST(Noise, AShelfEndsOnTwoWallsOfOnePart) {
  const MeshData walls = joined(wall(0, -1, 1), wall(1, -1, 1));
  const MeshData shelf{{0, -0.5, 0.3, 1, -0.5, 0.3, 1, 0.5, 0.3, 0, 0.5, 0.3}, {0, 1, 2, 0, 2, 3}};
  expect_verdict(Verdict::touching, walls, shelf);
  const MeshData through{{-0.5, -0.5, 0.3, 1.5, -0.5, 0.3, 1.5, 0.5, 0.3, -0.5, 0.5, 0.3}, {0, 1, 2, 0, 2, 3}};
  expect_verdict(Verdict::crossing, walls, through);
}

/// A pipe of 13 sides, open somewhere at its far end.
MeshData open_pipe(double low, double high, double far_end, double turn) {
  const auto circle = [&](double radius) {
    scenes::Outline outline;
    for (int i = 0; i < 13; ++i) {
      const double angle = 2 * std::numbers::pi * (i + turn) / 13;
      outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return outline;
  };
  MeshData pipe = scenes::ring(circle(2), circle(0.9), low, high);
  for (std::size_t t = 0; t < pipe.triangles.size(); t += 3) {
    const auto is_far = [&](std::size_t k) { return pipe.xyz[3 * pipe.triangles[t + k] + 2] == far_end; };
    if (!is_far(0) || !is_far(1) || !is_far(2)) continue;
    pipe.triangles.erase(pipe.triangles.begin() + static_cast<std::ptrdiff_t>(t),
                         pipe.triangles.begin() + static_cast<std::ptrdiff_t>(t + 3));
    break;
  }
  return pipe;
}

/// Their corners lie beyond the ends of each other's walls, within and without: before the end's face, not through it.
TEST(Noise, PipesThatAreSurfacesStandEndToEnd) {
  constexpr double kTolerance = 1e-3;
  const MeshData pipe = open_pipe(0, 5, 0, 0);
  for (const double turn : {0.0, 0.1, 0.5})
    for (const double gap : {0.0, 1e-5, -1e-5, 9e-4, -9e-4})
      expect_verdict(Verdict::touching, pipe, open_pipe(5 + gap, 10, 10, turn), kTolerance);
  expect_verdict(Verdict::apart, pipe, open_pipe(5.0011, 10, 10, 0.5), kTolerance);
  expect_verdict(Verdict::crossing, pipe, open_pipe(4.9, 10, 10, 0.5), kTolerance);
}

TEST(Noise, AChangedVerdictHasANote) {
  const MeshData large = box({0, 0, 0}, {10, 10, 10}), small = box({0.1, 0.1, 0.1}, {9.9, 9.9, 9.9});
  expect_verdict(Verdict::inside, large, small, std::nullopt, Note::none);
  expect_verdict(Verdict::duplicate, large, small, 0.2, Note::equal_within_tolerance);
  expect_verdict(Verdict::duplicate, large, large, 0.2, Note::none);
}

/// 0.5 thick each, in one part with a block: a tolerance of 0.3 must not excuse an overlap of 0.25.
TEST(Noise, AThinShellIsThinBesideAThickOne) {
  const MeshData sheet = box({0, 0, 0}, {4, 4, 0.5}), other = box({0, 0, 0.25}, {4, 4, 0.75});
  expect_verdict(Verdict::penetrating, joined(sheet, box({20, 0, 0}, {30, 10, 10})),
                 joined(other, box({-30, 0, 0}, {-20, 10, 10})), 0.3, Note::tolerance_not_applied);
}

/// Far out, where the tolerance is wider than the part: one box runs through the other all the same, which is no solid.
TEST(Noise, APartThatCrossesItselfIsNoSolidFarOut) {
  const MeshData crossing = joined(box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 3}));
  const MeshData crossing_cut = joined(box({0, 0, 0}, {2, 2, 2}, 3), box({1, 1, 1}, {3, 3, 3}, 3));
  const MeshData beside = joined(box({0, 0, 0}, {2, 2, 2}), box({2, 2, 0}, {4, 4, 2}, 3));
  for (const double far : {0.0, 1e6, 5e6}) {
    const auto out = [&](const MeshData& mesh) { return scenes::shifted(mesh, far, -far, far); };
    EXPECT_FALSE(examine(test::mesh_of(out(crossing)))->solid) << far;
    EXPECT_EQ(name(judged(out(crossing), out(crossing_cut), {}, std::nullopt).verdict), name(Verdict::duplicate));
    test::Seeded seeded(1);
    for (int i = 0; i < 4; ++i) {
      const MeshData turned = scenes::baked(beside, scenes::random_motion(seeded.random, far));
      EXPECT_TRUE(examine(test::mesh_of(turned))->solid) << far;
    }
  }
}

}  // namespace
}  // namespace impinge
