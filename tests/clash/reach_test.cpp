// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/reach.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clash/verdict.hpp"
#include "pipeline/mesh_pieces.hpp"
#include "pipeline/mesh_state.hpp"
#include "scenes/damaged.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::box;
using scenes::MeshData;

struct InPieces {
  Mesh mesh;
  std::shared_ptr<const MeshPieces> pieces;
  clash::PlacedPart part;
  InPieces(const MeshData& shape, const Pose& pose)
      : mesh(test::mesh_of(shape)),
        pieces(pieces_of(mesh, 1, {}).value()),
        part(placed_in_pieces(*pieces, solid::make_body(mesh.state().placed(pose)))) {}
};

struct Pair {
  InPieces in_a, in_b;
  Pair(const MeshData& shape_a, const MeshData& shape_b, const Pose& pose_a = {}, const Pose& pose_b = {})
      : in_a(shape_a, pose_a), in_b(shape_b, pose_b) {}
  [[nodiscard]] clash::Judgement verdict(const clash::PairReach& reach, double tolerance) const {
    return clash::verdict_at(tolerance, in_a.part, in_b.part, reach, false, {});
  }
  [[nodiscard]] clash::PairReach reach(double precision = 0.01) const {
    return clash::reach_between(in_a.part, in_b.part, {.precision = precision});
  }
};

clash::PairReach reach(const MeshData& a, const MeshData& b) { return Pair(a, b).reach(); }

struct Expected {
  double tolerance;
  Verdict verdict;
};

/// The tolerance below which the pair fails, and verdicts at some, also with the parts exchanged.
void expect(const std::string& what, const MeshData& a, const MeshData& b, double fails_below,
            const std::vector<Expected>& verdicts) {
  SCOPED_TRACE(what);
  for (const bool swapped : {false, true}) {
    const Pair pair = swapped ? Pair(b, a) : Pair(a, b);
    const clash::PairReach found = pair.reach();
    if (std::isinf(fails_below))
      EXPECT_EQ(found.fails_below(), fails_below);
    else
      EXPECT_NEAR(found.fails_below(), fails_below, 0.01 * fails_below + 0x1p-41 * 1000);
    for (const auto& [tolerance, verdict] : verdicts)
      EXPECT_EQ(name(pair.verdict(found, tolerance).verdict), name(verdict)) << "at " << tolerance;
  }
}

/// Plates, pins and walls in millimetres, known by hand.
TEST(Reach, IsWhatAnEngineerExpects) {
  using enum Verdict;
  const MeshData wall = box({0, 0, 0}, {1000, 400, 1000}), block = box({0, 0, 0}, {100, 100, 100});
  const MeshData plate = box({-100, -100, 0}, {100, 100, 5});
  expect("plates that cross", plate, box({-100, -2.5, -100}, {100, 2.5, 100}), kInfinity,
         {{0.001, penetrating}, {10, penetrating}, {1000, penetrating}});
  expect("a bolt through a plate", plate, scenes::shifted(scenes::pipe(24, 2, 4, 30, true), 0, 0, -10), kInfinity,
         {{0.001, penetrating}, {10, penetrating}});
  expect("a plate sunk into a wall", box({200, 397, 200}, {400, 402, 400}), wall, 3,
         {{0.1, penetrating}, {2.9, penetrating}, {3.1, touching}, {10, touching}});
  expect("a plate flush in a wall's face", box({200, 395, 200}, {400, 400, 400}), wall, 5,
         {{0.1, inside}, {4.9, inside}, {10, touching}});
  expect("a plate that overlaps by next to nothing", box({200, 400 - 1e-10, 200}, {400, 405, 400}), wall, 1e-10,
         {{0.001, touching}, {1, touching}, {2, touching}, {10, touching}});
  expect("a plate in the middle of a wall", box({200, 200, 200}, {400, 205, 400}), wall, kInfinity,
         {{0.001, inside}, {10, inside}, {1000, inside}});
  const auto pin = [](double depth) { return scenes::shifted(scenes::pipe(24, 4, 1, 40, true), 50, 50, 100 - depth); };
  expect("a pin 12 mm deep", pin(12), block, 12, {{0.1, penetrating}, {10, penetrating}, {13, touching}});
  expect("a pin 8 mm deep", pin(8), block, 8, {{0.1, penetrating}, {10, touching}});
  expect("a pin short of the block", pin(-3), block, 0, {{0.001, apart}, {2.9, apart}, {3.1, touching}});
  expect("side by side", box({100, 0, 0}, {150, 100, 100}), block, 0, {{1e-6, touching}, {10, touching}});
  expect("a spike of a thick part", scenes::joined(box({30, 30, 110}, {70, 70, 200}), pin(20)), block, 20,
         {{10, penetrating}, {21, touching}});
  expect("the same block", block, block, kInfinity, {{0.001, duplicate}, {10, duplicate}});
  expect("the same block in other triangles", block, box({0, 0, 0}, {100, 100, 100}, 3), kInfinity, {{1, duplicate}});
}

TEST(Reach, OfPiecesThatCoincideIsThroughWhateverElseThereIs) {
  const MeshData bolt = scenes::pipe(12, 1, 2, 10, true);
  MeshData bolts, others = scenes::shifted(bolt, 0, 100, 0);
  for (int i = 0; i < 8; ++i) {
    if (i == 7) others = scenes::joined(others, bolts);
    bolts = scenes::joined(bolts, scenes::shifted(bolt, 20 * i, 0, 0));
  }
  EXPECT_EQ(reach(bolts, others).fails_below(), kInfinity);
  // Two equal blocks with fins on opposite sides.
  const MeshData one = scenes::boundary({{0, 10, 30}, {0, 10, 11}, {0, 10}, [](int, int j, int) { return j == 0; }});
  const MeshData other = scenes::boundary({{-20, 0, 10}, {0, 10}, {0, 10}, [](int, int, int) { return true; }});
  EXPECT_EQ(reach(one, other).fails_below(), kInfinity);
}

TEST(Reach, OfAPlugWithANeedleIsTheNeedle) {
  const MeshData shell =
      scenes::joined(box({0, 0, 0}, {40, 40, 40}), scenes::inverted(box({10, 10, 10}, {30, 30, 30})));
  const MeshData plug = scenes::boundary({{10, 19, 21, 30}, {10, 19, 21, 30}, {10, 30, 34}, [](int i, int j, int k) {
                                            return k == 0 || (i == 1 && j == 1);
                                          }});
  const clash::PairReach found = reach(plug, shell);
  EXPECT_NEAR(found.a_in_b.lo, 4, 0.05);
  EXPECT_NEAR(found.a_in_b.hi, 4, 0.05);
}

TEST(Reach, OfSurfacesIsHowFarTheyStandOutOfEachOther) {
  const MeshData flat = scenes::shifted(scenes::scaled(scenes::flat_grid(1, 1), 10, 10, 1), -5, -5, 0);
  const MeshData upright = scenes::shifted(scenes::turned(scenes::turned(flat)), 0, 0, 2);
  EXPECT_NEAR(reach(flat, upright).fails_below(), 3, 1e-9);
  EXPECT_EQ(reach(flat, scenes::shifted(flat, 0, 0, 1)).fails_below(), 0);
  scenes::Random random(1);
  EXPECT_EQ(reach(flat, scenes::shuffled(flat, random)).fails_below(), kInfinity);
}

/// Decisions alone: the search ends as soon as each tolerance is decided, and no verdict differs.
TEST(Reach, LevelsChangeWhereTheSearchEndsAndNoVerdict) {
  std::vector<scenes::DamagedSolid> solids = scenes::damaged_solids(13);
  std::erase_if(solids, [](const scenes::DamagedSolid& solid) { return solid.damaged.triangle_count() > 1000; });
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Seeded seeded(seed);
    const auto draw = [&]() -> const scenes::DamagedSolid& {
      return solids[static_cast<std::size_t>(seeded.random.integer(0, static_cast<int>(solids.size()) - 1))];
    };
    const scenes::DamagedSolid &one = draw(), &other = draw();
    SCOPED_TRACE(one.name + " in " + other.name);
    const Pair pair(one.damaged, other.damaged, {}, scenes::random_motion(seeded.random, 0.5));
    const std::vector<double> tolerances{1e-4, 0.01, 0.1, 0.3};
    const clash::PairReach depth = pair.reach(),
                           decided = clash::reach_between(pair.in_a.part, pair.in_b.part,
                                                          {.precision = kInfinity, .levels = tolerances});
    for (const auto& [p, q] : {std::pair(depth.a_in_b, decided.a_in_b), std::pair(depth.b_in_a, decided.b_in_a)}) {
      EXPECT_LE(p.lo, q.hi);
      EXPECT_LE(q.lo, p.hi);
    }
    for (const double tolerance : tolerances) {
      if (pair.verdict(depth, tolerance).undecided) continue;
      EXPECT_EQ(name(pair.verdict(decided, tolerance).verdict), name(pair.verdict(depth, tolerance).verdict))
          << "at " << tolerance;
    }
  }
}

}  // namespace
}  // namespace impinge
