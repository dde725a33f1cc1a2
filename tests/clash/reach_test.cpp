// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/reach.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clash/reach_verdict.hpp"
#include "pipeline/part_in_pieces.hpp"
#include "scenes/damaged.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solid_pairs.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::box;
using scenes::MeshData;

struct Pair {
  Mesh a, b;
  PartInPieces in_a, in_b;
  Pair(const MeshData& shape_a, const MeshData& shape_b, const Pose& pose_a = {}, const Pose& pose_b = {})
      : a(test::mesh_of(shape_a)),
        b(test::mesh_of(shape_b)),
        in_a(place_in_pieces(a, pose_a)),
        in_b(place_in_pieces(b, pose_b)) {}
  [[nodiscard]] clash::ReachVerdict verdict(const clash::PairReach& reach, double tolerance) const {
    return clash::verdict_at(tolerance, in_a.part, in_b.part, reach, {});
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
  expect("a spike of a thick part", scenes::joined(box({30, 30, 110}, {70, 70, 200}), pin(20)), block, kInfinity,
         {{10, penetrating}});
  expect("the same block", block, block, kInfinity, {{0.001, duplicate}, {10, duplicate}});
  expect("the same block in other triangles", block, box({0, 0, 0}, {100, 100, 100}, 3), kInfinity, {{1, duplicate}});
}

TEST(Reach, OfPiecesThatCoincideIsThroughWhateverElseThereIs) {
  MeshData bolts;
  for (int i = 0; i < 8; ++i) {
    const MeshData bolt = scenes::shifted(scenes::pipe(12, 1, 2, 10, true), 20 * i, 0, 0);
    bolts = i == 0 ? bolt : scenes::joined(bolts, bolt);
  }
  MeshData others;
  for (int i = 0; i < 7; ++i) {
    const MeshData bolt = scenes::shifted(scenes::pipe(12, 1, 2, 10, true), 20 * i, 0, 0);
    others = i == 0 ? bolt : scenes::joined(others, bolt);
  }
  others = scenes::joined(others, scenes::shifted(scenes::pipe(12, 1, 2, 10, true), 0, 100, 0));
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

/// The winding number by the plain sum, and the distance by all triangles.
double plain_winding(const std::vector<Triangle>& triangles, const Vec3& p) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    sum += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2 * 3.14159265358979323846);
}
double plain_distance(const std::vector<Triangle>& triangles, const Vec3& p) {
  double least = kInfinity;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 along = t[(i + 1) % 3] - t[i];
      const double square = dot(along, along);
      const double s = square > 0 ? std::clamp(dot(along, p - t[i]) / square, 0.0, 1.0) : 0;
      least = std::min(least, norm(t[i] + s * along - p));
    }
    const Vec3 u = t[1] - t[0], v = t[2] - t[0], w = p - t[0], n = cross(u, v);
    const double square = dot(n, n);
    if (square == 0) continue;
    const double beta = dot(cross(w, v), n) / square, gamma = dot(cross(u, w), n) / square;
    if (beta >= 0 && gamma >= 0 && beta + gamma <= 1) least = std::min(least, std::abs(dot(n, w)) / std::sqrt(square));
  }
  return least;
}

/// The greatest distance found among points spread over the triangles.
double sampled_depth(const std::vector<Triangle>& inner, const std::vector<Triangle>& outer, scenes::Random& random) {
  double deepest = 0;
  double area = 0;
  for (const Triangle& t : inner) area += norm(cross(t[1] - t[0], t[2] - t[0]));
  for (const Triangle& t : inner) {
    const int points = 2 + static_cast<int>(1500 * norm(cross(t[1] - t[0], t[2] - t[0])) / area);
    for (int i = 0; i < points; ++i) {
      double u = random.unit(), v = random.unit();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 p = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      const double distance = plain_distance(outer, p);
      if (distance > deepest && std::abs(plain_winding(outer, p)) > 0.5) deepest = distance;
    }
  }
  return deepest;
}

TEST(Reach, OfDamagedSolidsIsWhatDensePointsFind) {
  std::vector<scenes::DamagedSolid> solids = scenes::damaged_solids(11);
  std::erase_if(solids, [](const scenes::DamagedSolid& solid) { return solid.damaged.triangle_count() > 1000; });
  int deep = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    const auto draw = [&]() -> const scenes::DamagedSolid& {
      return solids[static_cast<std::size_t>(random.integer(0, static_cast<int>(solids.size()) - 1))];
    };
    const scenes::DamagedSolid &one = draw(), &other = draw();
    SCOPED_TRACE(one.name + " in " + other.name);
    const Pose pose = scenes::random_motion(random, 0.5);
    const Pair pair(one.damaged, other.damaged, {}, pose);
    const clash::PairReach found = pair.reach(0.05);
    // The oracle's triangles are turned, as those of the pieces, since it takes winding numbers as they come.
    std::vector<Triangle> a, b;
    for (const auto& piece : pair.in_a.part.pieces)
      for (std::uint32_t t = 0; t < piece.body.size(); ++t) a.push_back(piece.body.triangle(t));
    for (const auto& piece : pair.in_b.part.pieces)
      for (std::uint32_t t = 0; t < piece.body.size(); ++t) b.push_back(piece.body.triangle(t));
    const double a_in_b = sampled_depth(a, b, random), b_in_a = sampled_depth(b, a, random);
    EXPECT_LE(a_in_b, found.a_in_b.hi + 1e-9);
    EXPECT_LE(b_in_a, found.b_in_a.hi + 1e-9);
    // Dense points miss the deepest by the gaps between them; inner points that count are deeper yet.
    EXPECT_GE(a_in_b, found.a_in_b.lo - 0.08);
    EXPECT_LE(found.a_in_b.hi, 1.06 * found.a_in_b.lo + 1e-5);
    // Depths are those of the sound solids, but for what the damage moved.
    const clash::PairReach sound = Pair(one.sound, other.sound, {}, pose).reach(0.05);
    const double moved = 2 * (one.damage + other.damage) + 1e-5;
    EXPECT_LE(found.a_in_b.lo, sound.a_in_b.hi + moved);
    EXPECT_LE(sound.a_in_b.lo, found.a_in_b.hi + moved);
    EXPECT_LE(found.b_in_a.lo, sound.b_in_a.hi + moved);
    EXPECT_LE(sound.b_in_a.lo, found.b_in_a.hi + moved);
    deep += found.fails_below() > 0.05 ? 1 : 0;
  }
  EXPECT_GT(deep, 20);
}

TEST(Reach, NamesPairsOfSolidsAsHandAndCountingDo) {
  std::size_t known = 0;
  for (const scenes::Family& family : scenes::solid_families()) {
    if (family.name == "SelfPassing") continue;  // solids by other rules
    for (const scenes::SolidPair& each : family.pairs) {
      if (!each.known || !each.solids) continue;
      SCOPED_TRACE(family.name + ", " + each.name);
      const Pair pair(each.a, each.b);
      const clash::ReachVerdict found = pair.verdict(pair.reach(0.05), 1e-9);
      EXPECT_EQ(name(found.verdict), name(each.known->verdict));
      EXPECT_EQ(found.inner, each.known->inner);
      ++known;
    }
  }
  EXPECT_GT(known, 700U);
}

}  // namespace
}  // namespace impinge
