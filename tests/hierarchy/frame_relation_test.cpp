// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/hierarchy/frame_relation_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hierarchy/frame_relation-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::test::HWY_NAMESPACE {

using hierarchy::Frame;
using hierarchy::TreeRelation;

/// Returns the instruction set that it ran on.
std::int64_t relate(const Frame& a, const Frame& b, const TreeRelation& relation, float (&C)[3][3], float (&c)[3]) {
  const auto found = hierarchy::HWY_NAMESPACE::relate_frames(a, b, relation);
  for (int i = 0; i < 3; ++i) {
    c[i] = found.c[i];
    for (int k = 0; k < 3; ++k) C[i][k] = found.columns[k][i];
  }
  return HWY_TARGET;
}

}  // namespace impinge::test::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/hierarchy/exact_frames.hpp"
#include "tests/hierarchy/tree_pair.hpp"

namespace impinge {
namespace test {
HWY_EXPORT(relate);
std::int64_t relate_anywhere(const hierarchy::Frame& a, const hierarchy::Frame& b,
                             const hierarchy::TreeRelation& relation, float (&C)[3][3], float (&c)[3]) {
  return HWY_DYNAMIC_DISPATCH(relate)(a, b, relation, C, c);
}
}  // namespace test
namespace {

using hierarchy::Frame;
using test::Rational3;

/// Of all nodes and leaves.
std::vector<Frame> frames_of(hierarchy::WideTree& tree) {
  std::vector<Frame> frames;
  hierarchy::MadeNodes made;
  std::vector<hierarchy::TreeRef> open{tree.root(made)};
  while (!open.empty()) {
    const hierarchy::TreeRef next = open.back();
    open.pop_back();
    frames.push_back(next.is_leaf() ? next.leaf().frame : next.node().frame);
    if (next.is_leaf()) continue;
    for (std::uint32_t lane = 0; lane < next.node().size; ++lane)
      open.push_back(tree.child(next.node(), static_cast<int>(lane), made));
  }
  return frames;
}

constexpr double kRounding = 0x1.00001p-24, kFar = 1e20;

/// C = F_A M F_Bᵀ, rounded once from what double made of it.
void expect_true_matrix(const Frame& a, const Frame& b, const hierarchy::TreeRelation& relation,
                        const float (&found)[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      mpq_class exact = 0;
      for (int l = 0; l < 3; ++l)
        for (int m = 0; m < 3; ++m)
          exact += mpq_class(a.axes[l][i]) * mpq_class(relation.rows[l][m]) * mpq_class(b.axes[m][k]);
      ASSERT_LE(abs(mpq_class(found[i][k]) - exact), kRounding * abs(exact) + mpq_class(0x1p-49));
    }
}

/// c = F_A (M scale o_B + t - o_A), off by a quarter of the relation's error at most before it is rounded.
void expect_true_offset(const Frame& a, const Frame& b, const hierarchy::TreeRelation& relation,
                        const float (&found)[3]) {
  Rational3 offset;
  for (std::size_t l = 0; l < 3; ++l) {
    offset[l] = mpq_class(relation.t[l]) - mpq_class(a.origin[l]);
    for (std::size_t m = 0; m < 3; ++m)
      offset[l] += mpq_class(relation.rows[l][m]) * mpq_class(relation.scale) * mpq_class(b.origin[m]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    mpq_class exact = 0;
    for (std::size_t l = 0; l < 3; ++l) exact += mpq_class(a.axes[l][i]) * offset[l];
    const mpq_class within = abs(exact) * kRounding + mpq_class(relation.error / 4) + mpq_class(0x1p-140);
    if (abs(exact) + within > kFar) {
      ASSERT_GE(std::abs(found[i]), 0.999 * kFar);
      ASSERT_LE(std::abs(found[i]), 1.001 * kFar);
      ASSERT_EQ(std::signbit(found[i]), sgn(exact) < 0);
    } else {
      ASSERT_LE(abs(mpq_class(found[i]) - exact), within);
    }
  }
}

void expect_true_relations(const scenes::PlacedScene& scene) {
  const test::TreePair pair(scene, 8);
  const auto frames_a = frames_of(pair.first().tree), frames_b = frames_of(pair.second().tree);
  for (const Frame& a : frames_a) {
    for (const Frame& b : frames_b)
      for (const std::int64_t set : test::instruction_sets()) {
        const test::OnInstructionSet on(set);
        float C[3][3], c[3];
        ASSERT_EQ(test::relate_anywhere(a, b, pair.relation(), C, c), set);
        ASSERT_NO_FATAL_FAILURE(expect_true_matrix(a, b, pair.relation(), C));
        ASSERT_NO_FATAL_FAILURE(expect_true_offset(a, b, pair.relation(), c));
      }
  }
}

TEST(FrameRelation, IsThatOfTheTreesOnEveryInstructionSet) {
  test::Seeded seeded(1);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 24)) {
    SCOPED_TRACE(named.name);
    expect_true_relations(named.scene);
  }
}

TEST(FrameRelation, HoldsForMeshesOfDifferentSizesFarAway) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    const double far = std::array{0.0, 1e6, 1e15}[seed % 3], small = std::ldexp(1.0, -random.integer(0, 80));
    scenes::PlacedScene scene =
        scenes::pair_scene(scenes::shifted(scenes::triangle_soup(random, 30, 1), far, far, -far),
                           scenes::scaled(scenes::triangle_soup(random, 30, 1), small, small, small));
    for (auto& object : scene.objects) {
      object.pose = scenes::random_motion(random, far);
      if (seed % 2 == 0) object.pose.R = scenes::stretched_rotation(random);
    }
    expect_true_relations(scene);
  }
}

}  // namespace
}  // namespace impinge
#endif
