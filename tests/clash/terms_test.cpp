// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// A scene put to several tests at once gives each pair of parts what it gets when it is judged on those terms alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "impinge/clash.hpp"
#include "scenes/shapes.hpp"
#include "tests/clash/same_clashes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

/// A row of boxes along x, some moved aside; from one to the next there is an overlap, a gap or
/// neither, of up to 1/4.
Scene row_of_boxes() {
  const Mesh mesh = test::mesh_of(scenes::box({0, 0, 0}, {2, 2, 2}));
  const std::vector<double> steps{1.75, 2.25, 2, 1.9999, 2.0001, 2 - 0x1p-24, 2 + 0x1p-24, 0};
  Scene scene;
  double x = 0;
  for (int i = 0; i < 24; ++i) {
    Pose pose;
    pose.t = {x, i % 3 == 0 ? 0.5 : 0, 0};
    EXPECT_TRUE(scene.add(mesh, pose));
    x += steps[static_cast<std::size_t>(i) % steps.size()];
  }
  return scene;
}

/// Bits of a pair's tests: some pairs are in none, some in all.
std::uint32_t tests_of(std::uint32_t a, std::uint32_t b) { return (a * 7 + b * 3) % 16; }

const std::vector<ClashTerms>& all_terms() {
  static const std::vector<ClashTerms> terms{
      {.tolerance = {}, .clearance = 0, .last = Verdict::crossing, .test = 10},
      {.tolerance = 0, .clearance = 1, .test = 11},
      {.tolerance = 0.125, .clearance = 0.1, .last = Verdict::touching, .test = 12},
      {.tolerance = {}, .clearance = 1, .last = Verdict::apart, .test = 13}};
  return terms;
}

TEST(Terms, GiveEachPairWhatItGetsOnThoseTermsAlone) {
  const Scene scene = row_of_boxes();
  ClashOptions options{.clearance = 1, .regions = true};
  options.terms = [](std::uint32_t a, std::uint32_t b, std::vector<ClashTerms>& terms) {
    EXPECT_LT(a, b);
    EXPECT_TRUE(terms.empty());
    for (std::size_t i = 0; i < all_terms().size(); ++i)
      if ((tests_of(a, b) >> i & 1U) != 0) terms.push_back(all_terms()[i]);
  };
  const Result<Clashes> found = find_clashes(scene, options);
  ASSERT_TRUE(found) << found.error().message;
  std::size_t expected = 0;
  for (std::size_t i = 0; i < all_terms().size(); ++i) {
    const ClashTerms& terms = all_terms()[i];
    const Result<Clashes> alone =
        find_clashes(scene, {.tolerance = terms.tolerance, .clearance = terms.clearance, .regions = true});
    ASSERT_TRUE(alone) << alone.error().message;
    std::vector<const Clash*> of_test, wanted;
    for (const Clash& clash : found->pairs)
      if (clash.test == terms.test) of_test.push_back(&clash);
    for (const Clash& clash : alone->pairs)
      if ((tests_of(clash.objects[0], clash.objects[1]) >> i & 1U) != 0 && clash.verdict <= terms.last)
        wanted.push_back(&clash);
    EXPECT_FALSE(wanted.empty()) << terms.test;
    ASSERT_EQ(of_test.size(), wanted.size()) << terms.test;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      Clash expected_of_test = *wanted[k];
      expected_of_test.test = terms.test;
      test::expect_same(expected_of_test, *of_test[k]);
    }
    expected += wanted.size();
  }
  EXPECT_EQ(found->pairs.size(), expected);
  for (std::size_t i = 1; i < found->pairs.size(); ++i) {
    const Clash &before = found->pairs[i - 1], &after = found->pairs[i];
    EXPECT_TRUE(std::tie(before.objects, before.test) < std::tie(after.objects, after.test)) << i;
  }
}

/// Copies of a part in one place, as the same mesh, as another with the same triangles and as one with others of the
/// same shape, and what is near them.
TEST(Terms, GiveEqualPartsInOnePlaceWhatEachPairGetsAlone) {
  const auto cube_of = [](double size, bool other_order) {
    scenes::MeshData cube = scenes::box({0, 0, 0}, {size, size, size});
    if (other_order) std::rotate(cube.triangles.begin(), cube.triangles.begin() + 3, cube.triangles.end());
    return test::mesh_of(cube);
  };
  const Mesh cube = cube_of(2, false), inner = cube_of(1, false);
  const std::vector<Mesh> meshes{cube, inner, cube_of(2, false), cube_of(2, true), cube, inner, cube};
  const std::vector<double> places{0, 0.5, 1.5, 2, 2.5, -0.0};
  std::vector<std::pair<Mesh, Pose>> parts;
  Scene scene;
  for (std::size_t i = 0; i < 5 * places.size(); ++i) {
    Pose pose;
    pose.t = {places[i % places.size()], 0, 0};
    parts.emplace_back(meshes[i % meshes.size()], pose);
    ASSERT_TRUE(scene.add(parts.back().first, pose));
  }
  for (const std::optional<double> tolerance : {std::optional<double>(), std::optional<double>(0)}) {
    ClashOptions options{.tolerance = tolerance, .clearance = 1, .regions = true};
    const Result<Clashes> found = find_clashes(scene, options);
    ASSERT_TRUE(found) << found.error().message;
    auto next = found->pairs.begin();
    for (std::uint32_t a = 0; a < parts.size(); ++a)
      for (std::uint32_t b = a + 1; b < parts.size(); ++b) {
        Clash alone = judge(parts[a].first, parts[a].second, parts[b].first, parts[b].second, options).value();
        alone.objects = {a, b};
        if (alone.verdict == Verdict::apart && !alone.nearest) continue;
        ASSERT_NE(next, found->pairs.end());
        test::expect_same(alone, *next++);
      }
    EXPECT_EQ(next, found->pairs.end());
  }
}

TEST(Terms, AreTheOnlyPairsThatAreLookedAt) {
  const Scene scene = row_of_boxes();
  ClashOptions options;
  options.terms = [](std::uint32_t, std::uint32_t, std::vector<ClashTerms>&) {};
  const Result<Clashes> none = find_clashes(scene, options);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->pairs.empty());
  EXPECT_EQ(none->candidates, 0U);
  EXPECT_EQ(none->parts.size(), 24U);
}

TEST(Terms, ThatReachFartherThanTheOptionsAreAnError) {
  const Scene scene = row_of_boxes();
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  for (const ClashTerms& terms :
       {ClashTerms{.tolerance = 6}, ClashTerms{.clearance = 6}, ClashTerms{.tolerance = -1},
        ClashTerms{.clearance = -1}, ClashTerms{.tolerance = kNothing}, ClashTerms{.clearance = kNothing}}) {
    ClashOptions options{.clearance = 5};
    options.terms = [&](std::uint32_t, std::uint32_t, std::vector<ClashTerms>& all) { all.push_back(terms); };
    const Result<Clashes> refused = find_clashes(scene, options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, Code::bad_option);
  }
}

}  // namespace
}  // namespace impinge
