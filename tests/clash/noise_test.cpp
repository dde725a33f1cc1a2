// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Parts whose verdict is plain, in shapes that a tolerance could mistake: each as it is and after rigid motions.
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "expect_verdict.hpp"
#include "impinge/clash.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solid_pairs.hpp"
#include "scenes/solids.hpp"

namespace impinge {
namespace {

using scenes::box;
using scenes::inverted;
using scenes::joined;
using scenes::MeshData;
using test::expect_verdict, test::judged;

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
  expect_verdict(Verdict::touching, plate, scenes::prism(scenes::regular(400, 1), 0, 1));
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
  MeshData pipe = scenes::ring(scenes::regular(13, 2, turn), scenes::regular(13, 0.9, turn), low, high);
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
  expect_verdict(Verdict::duplicate, large, small, 0.2);
  expect_verdict(Verdict::duplicate, large, large, 0.2, Note::none);
}

/// Their sides are cut where they meet the plate's top, so that no triangle crosses another.
TEST(Noise, AnOverlapThatNoPairCrossesInHasANoteToo) {
  const MeshData plate = box({0, 0, 0}, {4, 4, 1});
  const MeshData sunk = scenes::block({1, 3}, {1, 3}, {0.95, 1, 2}),
                 pin = scenes::block({1, 3}, {1, 3}, {0.2, 1, 1.05});
  expect_verdict(Verdict::penetrating, plate, sunk, 0.04);
  expect_verdict(Verdict::touching, plate, sunk, 0.06, Note::overlap_within_tolerance);
  expect_verdict(Verdict::penetrating, plate, pin, 0.04);
  expect_verdict(Verdict::inside, plate, pin, 0.06);
  const auto note = [&](const MeshData& other) { return sentence(judged(plate, other, {}, 0.06).note); };
  EXPECT_EQ(note(scenes::block({1, 3}, {1, 3}, {1, 2, 3})), sentence(Note::none));
  EXPECT_EQ(note(box({-2, 0, 0}, {0, 4, 1}, 3)), sentence(Note::none));
  EXPECT_EQ(note(scenes::block({1, 3}, {1, 3}, {0.25, 0.5, 1})), sentence(Note::none));
  // Flush on the plate's top and about its side, which no plane parts.
  const scenes::Cells hook{{2, 4, 5}, {1, 3}, {0, 1, 2}, [](int x, int, int z) { return x == 1 || z == 1; }};
  EXPECT_EQ(note(scenes::boundary(hook)), sentence(Note::none));
}

/// Every point of one is within the tolerance of the other, whatever is next to it and however it is cut.
TEST(Noise, WhatIsMovedByLessThanTheToleranceIsADuplicate) {
  constexpr double kTolerance = 0x1p-10;
  for (int trial = 0; trial < 100; ++trial) {
    test::Seeded seeded(static_cast<std::uint64_t>(trial));
    auto& random = seeded.random;
    const std::uint64_t bits = random.bits() | 1U;
    const auto is_filled = [bits](int x, int y, int z) { return (bits >> (4 * x + 2 * y + z) & 1U) != 0; };
    const auto is_half_filled = [&](int x, int y, int z) { return is_filled(x / 2, y / 2, z / 2); };
    const std::vector<double> whole{0, 1, 2}, halves{0, 0.5, 1, 1.5, 2};
    const Vec3 way{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Vec3 step = random.uniform(0.8, 0.97) * kTolerance / norm(way) * way;
    const MeshData a = scenes::boundary({halves, halves, halves, is_half_filled}, random.bits()),
                   coarse = scenes::boundary({whole, whole, whole, is_filled}, random.bits()),
                   b = scenes::shifted(coarse, step.x, step.y, step.z);
    const Pose pose = scenes::random_motion(random, 3);
    for (const bool swap : {false, true})
      EXPECT_EQ(name(judged(swap ? b : a, swap ? a : b, pose, kTolerance).verdict), name(Verdict::duplicate));
  }
}

/// Below the triangles in a strip along an edge the part is nowhere deep.
TEST(Noise, EqualPartsWithStripsNarrowerThanTheToleranceAreDuplicates) {
  for (int strips = 1; strips <= 4; ++strips) {
    std::vector<double> one_side{0}, both{0};
    for (int i = 1; i <= strips; ++i) one_side.push_back(0.9 * i / strips), both.push_back(0.9 * i / strips);
    one_side.push_back(100);
    for (int i = strips; i >= 0; --i) both.push_back(100 - 0.9 * i / strips);
    for (const std::vector<double>& cuts : {one_side, both}) {
      const MeshData block = scenes::block(cuts, cuts, cuts);
      expect_verdict(Verdict::duplicate, block, block, 1.0, Note::none);
      expect_verdict(Verdict::duplicate, block, scenes::shifted(block, 0.9, 0, 0), 1.0);
      expect_verdict(Verdict::touching, block, scenes::shifted(block, 99.1, 0, 0), 1.0, Note::overlap_within_tolerance);
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        test::Seeded seeded(seed);
        const MeshData a = scenes::shuffled(block, seeded.random), b = scenes::shuffled(block, seeded.random);
        EXPECT_EQ(name(judged(a, scenes::shifted(b, 0.9, 0, 0), {}, 1.0).verdict), name(Verdict::duplicate));
      }
    }
  }
}

/// 0.5 thick each, in one part with a block: a tolerance of 0.3 must not excuse an overlap of 0.25.
TEST(Noise, AThinShellIsThinBesideAThickOne) {
  const MeshData sheet = box({0, 0, 0}, {4, 4, 0.5}), other = box({0, 0, 0.25}, {4, 4, 0.75});
  expect_verdict(Verdict::penetrating, joined(sheet, box({20, 0, 0}, {30, 10, 10})),
                 joined(other, box({-30, 0, 0}, {-20, 10, 10})), 0.3);
}

/// Two blocks one on the other, cut into so many cells, and the second lifted.
MeshData stacked(int below, int above, double lift = 0) {
  return joined(box({0, 0, 0}, {4, 4, 2}, below), box({1, 1, 2 + lift}, {3, 3, 5}, above));
}

/// A bar bent to a square ring, one shell, of which one end is lower than the other that it faces.
MeshData closed_ring(double gap) {
  const auto is_bar = [](int x, int y, int z) {
    const bool is_rim = x == 0 || x == 2 || y == 0 || y == 4;
    return z == 0 && x >= 0 && x <= 2 && y >= 0 && y <= 4 && is_rim && !(x == 0 && y == 2);
  };
  MeshData ring = scenes::boundary({{0, 0.5, 3.5, 4}, {0, 0.5, 2, 3, 3.5, 4}, {0, 1}, is_bar});
  for (std::size_t i = 0; i < ring.xyz.size(); i += 3)
    if (ring.xyz[i] <= 0.5 && ring.xyz[i + 1] == 3)
      ring.xyz[i + 1] = 2 + gap, ring.xyz[i + 2] = 0.1 + 0.8 * ring.xyz[i + 2];
  return ring;
}

MeshData cut_sheet(double thick, int across, int through) {
  const auto cut = [](double length, int n) {
    std::vector<double> at;
    for (int i = 0; i <= n; ++i) at.push_back(length * i / n);
    return at;
  };
  return scenes::block(cut(10, across), cut(10, across), cut(thick, through), 3);
}

MeshData hollow(double wall) {
  return joined(box({0, 0, 0}, {4, 4, 4}), inverted(box({1, 1, 2}, {3, 3, 4 - wall}, 2)));
}

/// Shells that meet, pass through each other or fold back, and walls thinner than rounding far out.
TEST(Noise, ClosedPartsAreSolidsHoweverTheyAreTurned) {
  const MeshData block = box({0, 0, 0}, {2, 2, 2}, 2);
  struct Case {
    const char* what;
    MeshData mesh;
    double reach = 10;
  };
  const std::vector<Case> cases{
      {"stacked", stacked(1, 2)},
      {"stacked far out", stacked(3, 1), 1e4},
      {"stacked with a gap", stacked(1, 1, 1e-4)},
      {"a ring's ends that meet", closed_ring(0)},
      {"a ring's ends apart", closed_ring(9e-4)},
      {"an edge in common", joined(block, box({2, 2, 0}, {4, 4, 2}, 3))},
      {"a corner in common", joined(block, box({2, 2, 2}, {4, 4, 4}, 3))},
      {"through each other", joined(block, box({1, 1, 1}, {3, 3, 3})), 1e6},
      {"a cavity to the face", hollow(0)},
      {"a wall beside a cavity", hollow(1e-9)},
      {"a foil", box({0, 0, 0}, {1, 1, 1e-5}, 2), 100},
      {"slivers", cut_sheet(5e-4, 9, 9), 1e4},
      {"a cut foil", cut_sheet(1e-4, 9, 1), 1e4},
  };
  for (const Case& each : cases)
    for (std::uint64_t seed = 0; seed <= 6u; ++seed) {
      test::Seeded seeded(seed);
      const Pose pose = seed == 0 ? Pose{} : scenes::random_motion(seeded.random, each.reach);
      EXPECT_EQ(examine(test::mesh_of(each.mesh), pose)->part_class, PartClass::solid) << each.what;
      EXPECT_EQ(examine(test::mesh_of(scenes::baked(each.mesh, pose)))->part_class, PartClass::solid) << each.what;
    }
  EXPECT_GT(examine(test::mesh_of(stacked(1, 1)))->self_crossings, 0u);
  EXPECT_EQ(examine(test::mesh_of(stacked(1, 1, 1e-9)))->self_crossings, 0u);
}

TEST(Noise, WhatIsInStackedBlocksIsJudgedAlikeHoweverTheyAreTurned) {
  const MeshData within = box({1.5, 1.5, 0.5}, {2.5, 2.5, 1.5}), poking = box({2, 2, -1}, {3, 3, 1});
  for (std::uint64_t seed = 0; seed <= 6; ++seed) {
    test::Seeded seeded(seed);
    const Pose pose = seed == 0 ? Pose{} : scenes::random_motion(seeded.random, 10);
    const MeshData part = scenes::baked(stacked(3, 2), pose);
    EXPECT_EQ(name(judged(part, scenes::baked(within, pose), {}, std::nullopt).verdict), name(Verdict::inside));
    EXPECT_EQ(name(judged(part, scenes::baked(poking, pose), {}, std::nullopt).verdict), name(Verdict::penetrating));
  }
}

}  // namespace
}  // namespace impinge
