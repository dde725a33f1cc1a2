// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What `clash` makes of the library's verdicts: their order, and which of them fail.
#include "report/review.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "report/tolerance_advice.hpp"
#include "scene_command.hpp"

namespace impinge::report {
namespace {

Clash clash_of(Verdict verdict, std::uint32_t a, std::uint32_t b) {
  Clash pair;
  pair.verdict = verdict;
  pair.objects = {a, b};
  return pair;
}

TEST(Review, RanksWhatFailsByTheToleranceThenDepthThenAreaThenDistanceThenOrder) {
  std::vector<Clash> pairs{clash_of(Verdict::apart, 0, 1),       clash_of(Verdict::apart, 0, 2),
                           clash_of(Verdict::touching, 0, 3),    clash_of(Verdict::penetrating, 0, 4),
                           clash_of(Verdict::penetrating, 0, 5), clash_of(Verdict::penetrating, 0, 6),
                           clash_of(Verdict::crossing, 0, 7),    clash_of(Verdict::inside, 0, 8),
                           clash_of(Verdict::duplicate, 0, 9),   clash_of(Verdict::touching, 0, 10)};
  pairs[0].nearest = Nearest{.distance = 2};
  pairs[1].nearest = Nearest{.distance = 1};
  const auto deep = [&](std::size_t pair, double depth, double fails_below) {
    pairs[pair].overlap_depth = OverlapDepth{{0, 0.01}, {depth, depth + 0.01}};
    pairs[pair].fails_below = fails_below;
  };
  constexpr double kAlways = std::numeric_limits<double>::infinity();
  deep(3, 5, 5), deep(4, 3, kAlways), deep(5, 4, kAlways), deep(7, 2, 2), deep(9, 0.25, 0.25);
  pairs[6].fails_below = 3;
  pairs[8].fails_below = kAlways;
  pairs[9].regions = {Region{.area = 2}, Region{.area = 1}};
  pairs[2].regions = {Region{.area = 2.5}};
  EXPECT_EQ(ranked(pairs), (std::vector<std::size_t>{5, 4, 8, 3, 6, 7, 9, 2, 1, 0}));
  EXPECT_TRUE(ranked({}).empty());
}

TEST(Review, NamesAToleranceBelowTheWidestGap) {
  constexpr double kAlways = std::numeric_limits<double>::infinity();
  const auto repeated = [](std::size_t count, Reach reach) { return std::vector<Reach>(count, reach); };
  const std::vector<Reach> facets{{0.02}, {0.31}, {0.05}, {0.34}, {0.1}};  // three times as far apart at most
  struct Case {
    std::string_view what;
    std::vector<std::vector<Reach>> failing;
    double least, tolerance;  ///< that is named; 0: none
    std::size_t shallower;
  };
  const std::vector<Case> cases{
      {"facets and real clashes", {facets, {{4}, {5}, {kAlways, 9}}}, 1e-6, 0.35, 5},
      {"nothing but facets", {facets}, 1e-6, 0, 0},
      {"too few of them", {{{0.3}, {0.3}, {0.3}, {0.3}, {4}}}, 1e-6, 0, 0},
      {"less than a tenth", {facets, repeated(55, {4})}, 1e-6, 0, 0},
      {"a tenth", {facets, repeated(45, {4})}, 1e-6, 0.35, 5},
      {"no wide gap", {facets, {{1}, {2}, {4}}}, 1e-6, 0, 0},
      {"the widest of two", {facets, {{2}, {20}}}, 1e-6, 2.1, 6},
      {"depths that no tolerance excuses end the last gap", {facets, {{kAlways, 1.1}, {kAlways, 9}}}, 1e-6, 0.35, 5},
      {"but not those among the others", {facets, {{kAlways, 0.2}, {kAlways, 0.7}}}, 1e-6, 0, 0},
      {"nor surfaces, which have no depth", {facets, {{kAlways, 0}}}, 1e-6, 0, 0},
      {"above what is excused now", {facets, {{4}}}, 0.5, 0.51, 5},
      {"unless the gap ends there", {facets, {{4}}}, 2, 0, 0},
      {"lengths that are known to some per cent", {repeated(5, {0.34, 0.357}), {{4, 4.2}}}, 1e-6, 0.36, 5},
      {"not within what is known of one", {repeated(5, {0.3, 0.3}), {{0.4, 4}}}, 1e-6, 0, 0},
      {"one that is a round number", {repeated(5, {0.35}), {{4}}}, 1e-6, 0.36, 5},
      {"very small ones", {repeated(5, {1.234e-30}), {{1}}}, 1e-40, 1.3e-30, 5},
      {"very large ones", {repeated(5, {1.234e30}), {{1e32}}}, 1, 1.3e30, 5},
      {"the end of a decade", {repeated(5, {0.991}), {{4}}}, 1e-6, 1, 5},
      {"nothing fails", {}, 1e-6, 0, 0},
  };
  for (const Case& each : cases) {
    std::vector<Reach> failing;
    for (const auto& some : each.failing) failing.insert(failing.end(), some.begin(), some.end());
    const auto advice = advise_tolerance(failing, each.least);
    EXPECT_EQ(advice.has_value(), each.tolerance > 0) << each.what;
    if (!advice) continue;
    EXPECT_EQ(advice->tolerance, each.tolerance) << each.what;
    EXPECT_EQ(advice->shallower, each.shallower) << each.what;
    EXPECT_EQ(advice->shallower,
              static_cast<std::size_t>(std::ranges::count_if(
                  failing, [&](const Reach& reach) { return reach.fails_below <= advice->tolerance; })))
        << each.what;
  }
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
    for (const Verdict verdict : all)
      EXPECT_EQ(names(fail_on, verdict), named.contains(verdict)) << word << " " << static_cast<int>(verdict);
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
