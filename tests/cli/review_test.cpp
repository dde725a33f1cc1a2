// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What `clash` makes of the library's verdicts: their order, and which of them fail.
#include "report/review.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>
#include <utility>

#include "scene_command.hpp"

namespace impinge::report {
namespace {

Clash clash_of(Verdict verdict, std::uint32_t a, std::uint32_t b) {
  Clash pair;
  pair.verdict = verdict;
  pair.objects = {a, b};
  return pair;
}

TEST(Review, RanksByVerdictThenDepthThenAreaThenDistanceThenOrder) {
  std::vector<Clash> pairs{clash_of(Verdict::apart, 0, 1),       clash_of(Verdict::apart, 0, 2),
                           clash_of(Verdict::touching, 0, 3),    clash_of(Verdict::penetrating, 0, 4),
                           clash_of(Verdict::penetrating, 0, 5), clash_of(Verdict::penetrating, 0, 6),
                           clash_of(Verdict::crossing, 0, 7),    clash_of(Verdict::inside, 0, 8),
                           clash_of(Verdict::duplicate, 0, 9),   clash_of(Verdict::touching, 0, 10)};
  pairs[0].nearest = Nearest{.distance = 2};
  pairs[1].nearest = Nearest{.distance = 1};
  pairs[4].overlap_depth = OverlapDepth{{0.1, 0.2}, {3, 3.01}};
  pairs[5].overlap_depth = OverlapDepth{{5, 5.01}, {0, 0}};
  pairs[9].regions = {Region{.area = 2}, Region{.area = 1}};
  pairs[2].regions = {Region{.area = 2.5}};
  EXPECT_EQ(ranked(pairs), (std::vector<std::size_t>{8, 7, 5, 4, 3, 6, 9, 2, 1, 0}));
  EXPECT_TRUE(ranked({}).empty());
}

TEST(Review, FailsWhatEachWordNames) {
  using enum Verdict;
  const std::vector<Verdict> all{duplicate, inside, penetrating, crossing, touching, apart};
  const std::map<std::string, std::pair<FailOn, std::set<Verdict>>> words{
      {"contact", {{.contact = true}, {duplicate, inside, penetrating, crossing, touching}}},
      {"penetration", {{.penetration = true}, {duplicate, penetrating, crossing}}},
      {"inside", {{.inside = true}, {inside}}},
      {"clearance", {{.clearance = true}, {apart}}},
  };
  for (const auto& [word, meaning] : words) {
    const auto& [fail_on, named] = meaning;
    EXPECT_EQ(words_of(fail_on), std::vector<std::string>{word});
    for (const Verdict verdict : all) {
      EXPECT_EQ(names(fail_on, verdict), named.contains(verdict)) << word << " " << static_cast<int>(verdict);
    }
  }
  EXPECT_EQ(words_of(ReportOptions{}.fail_on), (std::vector<std::string>{"penetration", "inside"}));
}

/// Objects that are one and the same triangle, of these products of these files.
Assembly triangles_of(const std::vector<std::pair<std::uint32_t, std::string>>& products) {
  const std::vector<double> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::vector<std::uint32_t> triangle{0, 1, 2};
  const Mesh mesh = Mesh::create(std::span<const double>(xyz), triangle).value();
  Assembly assembly;
  assembly.files = {"a.ifc", "b.ifc"};
  for (const auto& [file, product] : products) {
    assembly.objects.push_back({"part", "part", product, mesh, {}});
    assembly.file_of.push_back(file);
  }
  assembly.labels = labels_of(assembly);
  return assembly;
}

TEST(Review, PartsOfOneProductOfOneFileHaveOneNumber) {
  const Assembly assembly =
      triangles_of({{0, "IfcDoor_1"}, {0, ""}, {0, "IfcWall_2"}, {0, "IfcDoor_1"}, {1, "IfcDoor_1"}, {1, ""}});
  const std::vector<std::uint32_t> numbers = products_of(assembly);
  ASSERT_EQ(numbers.size(), 6U);
  EXPECT_EQ(numbers[0], numbers[3]);
  EXPECT_EQ(std::set(numbers.begin(), numbers.end()).size(), 4U);
  EXPECT_EQ(numbers[1], 0U);
  EXPECT_EQ(numbers[5], 0U);
  EXPECT_EQ(count_shared(numbers), 1U);
  EXPECT_EQ(count_shared({}), 0U);
  EXPECT_EQ(count_shared({0, 0, 2, 1, 2, 2, 3, 1}), 2U);
}

TEST(Review, PartsOfOneProductAreTestedAgainstEachOtherOnlyIfAskedFor) {
  using Pairs = std::vector<std::array<std::uint32_t, 2>>;
  const Assembly assembly = triangles_of({{0, "IfcDoor_1"}, {0, "IfcDoor_1"}, {0, ""}, {1, "IfcDoor_1"}});
  const auto tested = [&](const ReportOptions& options) {
    return scene_of(assembly, options, groups_of(assembly, options)).value().collide().value().objects;
  };
  EXPECT_EQ(tested({}), (Pairs{{0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  ReportOptions within;
  within.within_products = true;
  EXPECT_EQ(tested(within), (Pairs{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  // `check` knows nothing of products.
  EXPECT_EQ(scene_of(assembly, SceneOptions{}).value().collide().value().objects, tested(within));
}

}  // namespace
}  // namespace impinge::report
