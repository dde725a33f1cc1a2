// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/settle.hpp"

#include <gtest/gtest.h>

#include "core/pose.hpp"
#include "exact/triangle_pair.hpp"
#include "impinge/predicates.hpp"
#include "pairs.hpp"
#include "scenes/motion.hpp"
#include "tests/core/instruction_sets.hpp"

namespace impinge {
namespace {

using exact::Contact;
using scenes::Random;
using test::Pair;

void add_triangle(MeshData& mesh, const Triangle& triangle) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
  std::vector<MeshData::Corners> triangles(mesh.triangles.begin(), mesh.triangles.end());
  triangles.push_back({first, first + 1, first + 2});
  mesh.set_triangles(std::move(triangles));
}

/// Pairs of equal triangle ids in two meshes at the identity, and what becomes of them.
struct Known {
  MeshData a, b;
  std::vector<TrianglePair> pairs;
  std::vector<Contact> contacts;

  void add(const Pair& pair, std::optional<Kind> kind) {
    const auto id = static_cast<std::uint32_t>(pairs.size());
    add_triangle(a, pair[0]), add_triangle(b, pair[1]);
    pairs.push_back({id, id});
    if (kind) contacts.push_back({id, id, *kind});
  }
  [[nodiscard]] Pair pair(std::uint32_t id) const {
    Pair pair;
    for (std::size_t i = 0; i < 3; ++i) pair[0][i] = a.vertices[3 * id + i], pair[1][i] = b.vertices[3 * id + i];
    return pair;
  }
};

void expect_same(const Known& known, const std::vector<Contact>& found) {
  std::size_t e = 0, f = 0;
  const auto& expected = known.contacts;
  while (e < expected.size() && f < found.size() && expected[e].a == found[f].a && found[f].a == found[f].b &&
         expected[e].kind == found[f].kind)
    ++e, ++f;
  if (e == expected.size() && f == found.size()) return;
  const std::uint32_t id =
      std::min(e < expected.size() ? expected[e].a : 0xFFFFFFFF, f < found.size() ? found[f].a : 0xFFFFFFFF);
  ADD_FAILURE() << expected.size() << " contacts expected, " << found.size()
                << " found; the first that differs: " << test::written(known.pair(id));
}

std::vector<Contact> settled(const Known& known) {
  std::vector<Contact> contacts;
  exact::settle(known.a, {}, known.b, {}, known.pairs, contacts);
  return contacts;
}

class PairFamilies : public testing::TestWithParam<test::PairFamily> {
 protected:
  static constexpr std::uint64_t kSeed = 20240501;
  static constexpr int kRounds = 850, kVariants = 50;

  Random random_{kSeed};
  testing::ScopedTrace trace_{__FILE__, __LINE__, "seed " + std::to_string(kSeed)};
};

/// More than a million pairs in all families, each an image of one that is known by rationals.
TEST_P(PairFamilies, AreSettledAndClassifiedAsByRationals) {
  Known known;
  std::array<int, 4> seen{};
  for (int i = 0; i < kRounds; ++i) {
    const Pair pair = GetParam().make(random_);
    const auto kind = test::kind_of(pair);
    ++seen[kind ? static_cast<std::size_t>(*kind) : 3];
    known.add(pair, kind);
    for (int k = 0; k < kVariants; ++k) known.add(test::varied(pair, random_), kind);
  }
  EXPECT_GT(seen[3], 0);
  EXPECT_LT(seen[3], kRounds);
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    expect_same(known, settled(known));
  }
  std::vector<Contact> contacts;
  for (const TrianglePair& p : known.pairs) {
    const Pair pair = known.pair(p.a);
    if (const auto kind = exact::classify(pair[0], pair[1])) contacts.push_back({p.a, p.b, *kind});
  }
  expect_same(known, contacts);
}

/// Whatever is known beforehand and whichever arithmetic decides, the outcome is one. The integers are those of
/// exact/integers.cpp here.
TEST_P(PairFamilies, AreDecidedAlikeByIntegersAndExpansions) {
  using exact::Outcome, exact::PairSigns;
  int fitting = 0;
  for (int i = 0; i < kRounds; ++i) {
    const Pair pair = test::varied(GetParam().make(random_), random_);
    const auto kind = test::kind_of(pair);
    const std::array points{pair[0][0], pair[0][1], pair[0][2], pair[1][0], pair[1][1], pair[1][2]};
    PairSigns signs;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) signs.set(PairSigns::kShared + 3 * a + b, unsigned{pair[0][a] == pair[1][b]});
    for (int v = 0; v < 6; ++v) {
      if (random_.integer(0, 1) == 0) continue;
      const Triangle& plane = pair[v < 3 ? 1 : 0];
      const int side = test::side_of(plane[0], plane[1], plane[2], points[v]);
      signs.set(PairSigns::side_bit(side > 0   ? PairSigns::kAbove
                                    : side < 0 ? PairSigns::kBelow
                                               : PairSigns::kOn,
                                    v / 3, v % 3),
                1);
    }
    const auto by = [&](const auto& p) {
      const Outcome outcome = exact::decide(signs, p);
      return kind_of(outcome == Outcome::open ? exact::decide_degenerate(points) : outcome);
    };
    ASSERT_EQ(by(points), kind) << test::written(pair);
    std::array<exact::IntVec, 6> integers;
    if (!exact::to_integers(points, integers.data())) continue;
    ++fitting;
    ASSERT_EQ(by(integers), kind) << test::written(pair);
  }
  std::cout << fitting << " of " << kRounds << " pairs fit into integers\n";
}

INSTANTIATE_TEST_SUITE_P(Pairs, PairFamilies, testing::ValuesIn(test::pair_families()), test::family_name);

/// In any order, many times the same; coplanar but for rounding.
TEST(Settle, TakesPairsOfPlacedMeshes) {
  Random random(7);
  for (const double reach : {0.0, 10.0, 1e6})
    for (int round = 0; round < 8; ++round) {
      const Pose pose_a = scenes::random_motion(random, reach);
      Pose pose_b = pose_a;
      if (round % 2 == 1) pose_b = {.R = scenes::stretched_rotation(random), .t = pose_a.t};
      Known known;  // one mesh of few vertices, many triangles
      for (MeshData* mesh : {&known.a, &known.b}) {
        for (int i = 0; i < 27; ++i) mesh->vertices.push_back({i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0});
        std::vector<MeshData::Corners> triangles;
        for (int i = 0; i < 40; ++i) {
          const auto vertex = [&] { return static_cast<std::uint32_t>(random.integer(0, 26)); };
          const std::uint32_t u = vertex(), v = vertex();
          triangles.push_back({u, v, vertex()});
        }
        mesh->set_triangles(std::move(triangles));
      }
      const auto world = [](const MeshData& mesh, const Pose& pose, std::uint32_t id) {
        Triangle triangle;
        for (std::size_t i = 0; i < 3; ++i) triangle[i] = world_vertex(pose, mesh.vertices[mesh.triangles[id][i]]);
        return triangle;
      };
      std::vector<Contact> expected{{5, 6, Kind::coplanar}}, found = expected;  // appended to
      for (int i = 0; i < 101; ++i) {
        const auto a = static_cast<std::uint32_t>(random.integer(0, 39)),
                   b = static_cast<std::uint32_t>(random.integer(0, 39));
        known.pairs.push_back({a, b});
        const auto kind = test::kind_of({world(known.a, pose_a, a), world(known.b, pose_b, b)});
        if (kind) expected.push_back({a, b, *kind});
      }
      for (const std::int64_t set : test::instruction_sets()) {
        const test::OnInstructionSet on(set);
        found.resize(1);
        exact::settle(known.a, pose_a, known.b, pose_b, known.pairs, found);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
          EXPECT_EQ(found[i].a, expected[i].a);
          EXPECT_EQ(found[i].b, expected[i].b);
          EXPECT_EQ(found[i].kind, expected[i].kind);
        }
      }
    }
}

TEST(Settle, TakesAnyNumberOfPairs) {
  Known known;
  const Triangle t{Point{0, 0, 0}, Point{4, 0, 0}, Point{0, 4, 0}};
  const std::vector<std::pair<Triangle, std::optional<Kind>>> others{
      {{Point{1, 1, -1}, Point{1, 1, 1}, Point{9, 9, 0}}, Kind::crossing},
      {{Point{4, 0, 0}, Point{0, 4, 0}, Point{4, 4, 0}}, Kind::coplanar},
      {{Point{0, 0, 1}, Point{4, 0, 1}, Point{0, 4, 1}}, std::nullopt},
      {{Point{1, 1, 0}, Point{1, 1, 1}, Point{9, 9, 1}}, Kind::touching},
      {{Point{1, 1, 0}, Point{1, 1, 0}, Point{1, 1, 0}}, Kind::touching}};
  for (int n = 0; n <= 20; ++n) {
    SCOPED_TRACE(n);
    expect_same(known, settled(known));
    const auto& [other, kind] = others[static_cast<std::size_t>(n) % others.size()];
    known.add({t, other}, kind);
  }
  std::vector<Contact> contacts;
  exact::settle({}, {}, {}, {}, {}, contacts);  // meshes without triangles
  EXPECT_TRUE(contacts.empty());
}

/// Equal corners, planes along the axes and the general case, and pairs that need more.
TEST(Settle, KnowsPairsThatFloatingPointCanTellAndOthers) {
  const Triangle t{Point{0, 0, 0.3}, Point{4, 0, 0.3}, Point{0, 4, 0.3}};
  Known certain, open;
  certain.add({t, t}, Kind::coplanar);
  certain.add({t, {t[1], Point{5, 5, 0.3}, Point{5, 4, 0.3}}}, Kind::coplanar);
  certain.add({t, {t[1], Point{5, 5, 0.3}, Point{5, 4, 0.4}}}, Kind::touching);
  certain.add({t, {t[1], t[0], Point{5, 4, 0.4}}}, Kind::touching);
  certain.add({t, {t[0], Point{1, 1, 0}, Point{1, 1, 1}}}, Kind::crossing);
  certain.add({t, {Point{1, 1, 1}, Point{2, 1, 1}, Point{1, 2, 0.4}}}, std::nullopt);
  open.add({t, {Point{1, 1, 0}, Point{1, 2, 0}, Point{1, 1, 1}}}, Kind::crossing);
  open.add({t, {Point{1, 1, 0.3}, Point{2, 1, 0.3}, Point{1, 2, 0.3}}}, Kind::coplanar);
  std::vector<Contact> contacts;
  exact::settle(certain.a, {}, certain.b, {}, certain.pairs, contacts);
  expect_same(certain, contacts);
  contacts.clear();
  exact::settle(open.a, {}, open.b, {}, open.pairs, contacts);
  expect_same(open, contacts);
}

}  // namespace
}  // namespace impinge
