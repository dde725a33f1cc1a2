// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The oracle for verdicts against what is known by hand and by counting, and against itself.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "expected.hpp"
#include "scenes/solid_pairs.hpp"
#include "scenes/solids.hpp"

namespace impinge {
namespace {

using scenes::Family;
using scenes::SolidPair;

class VerdictOracle : public testing::TestWithParam<Family> {};

TEST_P(VerdictOracle, SaysWhatIsKnown) {
  for (const SolidPair& pair : GetParam().pairs) {
    SCOPED_TRACE(pair.name);
    if (pair.solids && pair.known) {
      EXPECT_EQ(expected::computed_judgement(pair), *pair.known);
    }
  }
}

TEST_P(VerdictOracle, SaysItTheOtherWayRound) {
  std::size_t i = 0;
  for (const SolidPair& pair : GetParam().pairs) {
    if (!pair.solids || ++i % 7 != 0) continue;
    SCOPED_TRACE(pair.name);
    scenes::Judgement swapped = expected::computed_judgement(pair);
    swapped.inner = swapped.inner < 0 ? -1 : 1 - swapped.inner;
    EXPECT_EQ(expected::computed_judgement({pair.name, scenes::inverted(pair.b), scenes::unshared(pair.a), {}}),
              swapped);
  }
}

TEST_P(VerdictOracle, SaysItOfTetrahedraToo) {
  std::size_t i = 0;
  for (const SolidPair& pair : GetParam().pairs) {
    // Dear for those of many triangles.
    if (pair.solids && pair.a.triangle_count() + pair.b.triangle_count() <= 64 && ++i % 5 == 0) {
      SCOPED_TRACE(pair.name);
      EXPECT_EQ(expected::judgement_by_tetrahedra(pair), expected::computed_judgement(pair));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, VerdictOracle, testing::ValuesIn(scenes::solid_families()),
                         [](const auto& family) { return family.param.name; });

TEST(SolidPairs, HaveNamesOfTheirOwn) {
  for (const Family& family : scenes::solid_families()) {
    std::set<std::string> names;
    for (const SolidPair& pair : family.pairs) {
      EXPECT_TRUE(names.insert(pair.name).second) << family.name << ": " << pair.name;
      EXPECT_TRUE(pair.solids || pair.known) << family.name << ": nobody knows about " << pair.name;
    }
  }
}

TEST(SolidPairs, RandomFamiliesHaveEveryVerdict) {
  for (const auto& pairs : {scenes::voxel_pairs(1, 120), scenes::interval_pairs(1)}) {
    std::map<Verdict, int> seen;
    for (const SolidPair& pair : pairs) ++seen[pair.known->verdict];
    for (const Verdict verdict :
         {Verdict::duplicate, Verdict::inside, Verdict::penetrating, Verdict::touching, Verdict::apart}) {
      EXPECT_GT(seen[verdict], 0) << static_cast<int>(verdict);
    }
  }
}

}  // namespace
}  // namespace impinge
