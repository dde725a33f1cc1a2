// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

/// Objects that cross, touch, lie in one plane, and do nothing of the kind; some share no contact of a wanted kind.
scenes::PlacedScene mixed_scene() {
  scenes::Random random(11);
  scenes::PlacedScene scene = scenes::flush_boxes(2, 2, 2);
  scene.meshes.push_back(scenes::integer_soup(random, 40, 3));
  scene.meshes.push_back(scenes::degenerate_soup(random, 30, 3));
  scene.meshes.push_back(scenes::triangle_soup(random, 60, 0.5));
  scene.objects.push_back({.mesh = 1});
  scene.objects.push_back({.mesh = 2});
  scene.objects.push_back({.mesh = 3, .pose = scenes::random_motion(random, 1)});
  scene.objects.push_back({.mesh = 3, .pose = scenes::random_motion(random, 1)});
  scene.objects.push_back({.mesh = 0, .pose = {.t = {50, 0, 0}}});
  return scene;
}

TEST(Options, ThatCannotBeAreRefused) {
  const Scene scene = test::scene_of(mixed_scene());
  const Mesh cube = test::mesh_of(scenes::cube());
  const auto expect_refused = [&](const Options& options, const char* word) {
    for (const auto& result : {scene.collide(options), collide(cube, {}, cube, {}, options)}) {
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().code, Code::bad_option);
      EXPECT_NE(result.error().message.find(word), std::string::npos) << result.error().message;
    }
  };
  expect_refused({.threads = -1}, "-1");
  expect_refused({.kinds = 8}, "kinds");
  expect_refused({.kinds = 255}, "kinds");
  expect_refused({.find = static_cast<Options::Find>(2)}, "find");
  expect_refused({.backend = "vulkan"}, "'vulkan'");
  expect_refused({.backend = ""}, "auto");
  for (const char* backend : {"auto", "simd", "paper"}) EXPECT_TRUE(scene.collide({.backend = backend}));
}

/// Each backend honours them by code of its own.
class WithBackend : public testing::TestWithParam<const char*> {
 protected:
  static Options with(Options options) {
    options.backend = GetParam();
    return options;
  }
};
INSTANTIATE_TEST_SUITE_P(Options, WithBackend, testing::Values("auto", "simd", "paper"),
                         [](const auto& backend) { return backend.param; });

TEST_P(WithBackend, KindsFilterTheAnswer) {
  const Scene scene = test::scene_of(mixed_scene());
  const std::vector<test::Contact> all = test::listed(scene.collide(with({})).value());
  EXPECT_EQ(all, test::brute_force(mixed_scene()));
  for (std::uint8_t kinds = 0; kinds <= kAllKinds; ++kinds) {
    std::vector<test::Contact> expected;
    for (const test::Contact& contact : all)
      if (kinds >> contact[4] & 1) expected.push_back(contact);
    const Contacts found = scene.collide(with({.kinds = kinds})).value();
    EXPECT_EQ(test::listed(found), expected);
    EXPECT_FALSE(found.truncated);
    if (kinds == kCrossing || kinds == kTouching || kinds == kCoplanar) {
      EXPECT_GT(expected.size(), 10u);
    }
  }
}

TEST_P(WithBackend, LimitKeepsThePrefixOfTheFullAnswer) {
  const Scene scene = test::scene_of(mixed_scene());
  for (const std::uint8_t kinds : {kAllKinds, kTouching}) {
    const std::vector<test::Contact> all = test::listed(scene.collide(with({.kinds = kinds})).value());
    for (const std::size_t limit :
         {std::size_t{0}, std::size_t{1}, all.size() / 2, all.size() - 1, all.size(), all.size() + 1}) {
      for (const int threads : {1, 0}) {
        const Contacts found = scene.collide(with({.limit = limit, .kinds = kinds, .threads = threads})).value();
        const std::size_t kept = std::min(limit, all.size());
        EXPECT_EQ(test::listed(found),
                  std::vector<test::Contact>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept)));
        EXPECT_EQ(found.truncated, kept < all.size());
      }
    }
  }
}

TEST_P(WithBackend, LimitCutsLargeAnswersToo) {
  const Mesh plane = test::mesh_of(scenes::flat_grid(40, 40));
  const std::vector<test::Contact> all = test::listed(collide(plane, {}, plane, {}, with({})).value());
  EXPECT_GT(all.size(), 30000u);
  for (const std::size_t limit : {100, 5000, 20000}) {
    const Contacts found = collide(plane, {}, plane, {}, with({.limit = limit})).value();
    EXPECT_EQ(test::listed(found),
              std::vector<test::Contact>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(limit)));
    EXPECT_TRUE(found.truncated);
  }
}

/// Every pair of objects with a contact of a wanted kind, and one true witness each.
TEST_P(WithBackend, FirstContactFindsEachTouchingPairWithATrueWitness) {
  const scenes::PlacedScene placed = mixed_scene();
  const Scene scene = test::scene_of(placed);
  const std::vector<test::Contact> all = test::listed(scene.collide(with({})).value());
  const std::set<test::Contact> truths(all.begin(), all.end());
  for (std::uint8_t kinds = 0; kinds <= kAllKinds; ++kinds) {
    std::vector<std::array<std::uint32_t, 2>> expected;
    for (const test::Contact& contact : all) {
      if ((kinds >> contact[4] & 1) == 0) continue;
      if (expected.empty() || expected.back() != std::array{contact[0], contact[1]})
        expected.push_back({contact[0], contact[1]});
    }
    for (const int threads : {1, 0}) {
      const Contacts found =
          scene.collide(with({.find = Options::Find::first, .kinds = kinds, .threads = threads})).value();
      EXPECT_EQ(found.objects, expected);
      EXPECT_EQ(found.triangles.size(), expected.size());
      EXPECT_EQ(found.hash, 0u);
      EXPECT_FALSE(found.truncated);
      for (const test::Contact& witness : test::listed(found)) {
        EXPECT_TRUE(truths.contains(witness));
        EXPECT_TRUE(kinds >> witness[4] & 1);
      }
    }
  }
}

TEST_P(WithBackend, FirstContactHonoursALimit) {
  const Scene scene = test::scene_of(mixed_scene());
  const auto all = scene.collide(with({.find = Options::Find::first}))->objects;
  for (const std::size_t limit : {std::size_t{0}, std::size_t{3}, all.size()}) {
    const Contacts found = scene.collide(with({.find = Options::Find::first, .limit = limit})).value();
    EXPECT_EQ(found.objects, std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(limit)));
    EXPECT_EQ(found.truncated, limit < all.size());
  }
}

/// A pair of its own, as a scene has it by brute force, with the clock and without: most are answered by one thread and
/// without what shares work and puts rows together.
TEST_P(WithBackend, PairsHaveTheAnswersOfTheirScene) {
  const scenes::PlacedScene placed = mixed_scene();
  const std::vector<Mesh> meshes = test::meshes_of(placed);
  const std::vector<test::Contact> all = test::brute_force(placed);
  const auto expect = [&](std::uint32_t a, std::uint32_t b, const Options& options) {
    std::vector<test::Contact> wanted;
    for (const test::Contact& c : all)
      if (c[0] == a && c[1] == b && (options.kinds >> c[4] & 1) != 0) wanted.push_back({0, 1, c[2], c[3], c[4]});
    const auto &first = placed.objects[a], &second = placed.objects[b];
    const Contacts found = collide(meshes[first.mesh], first.pose, meshes[second.mesh], second.pose, options).value();
    const bool is_first = options.find == Options::Find::first;
    const std::size_t findable = is_first ? std::min<std::size_t>(wanted.size(), 1) : wanted.size();
    const auto kept = static_cast<std::size_t>(std::min<std::uint64_t>(findable, options.limit));
    EXPECT_EQ(found.truncated, kept < findable);
    EXPECT_EQ(found.partial, is_first || options.kinds != kAllKinds);
    EXPECT_EQ(found.offsets, kept == 0 ? std::vector<std::uint64_t>{0} : (std::vector<std::uint64_t>{0, kept}));
    ASSERT_EQ(found.triangles.size(), kept);
    const std::vector<test::Contact> listed = test::listed(found);
    if (is_first) {
      EXPECT_EQ(found.hash, 0u);
      for (const test::Contact& witness : listed) EXPECT_EQ(std::count(wanted.begin(), wanted.end(), witness), 1);
    } else {
      EXPECT_TRUE(std::equal(listed.begin(), listed.end(), wanted.begin()));
      const Options by_paper{.limit = options.limit, .kinds = options.kinds, .threads = 1, .backend = "paper"};
      EXPECT_EQ(found.hash, collide(meshes[first.mesh], first.pose, meshes[second.mesh], second.pose, by_paper)->hash);
    }
  };
  for (std::uint32_t a = 0; a < placed.objects.size(); ++a)
    for (std::uint32_t b = a + 1; b < placed.objects.size(); ++b)
      for (const auto find : {Options::Find::all, Options::Find::first})
        for (const std::uint8_t kinds : {kAllKinds, kTouching})
          for (const std::uint64_t limit : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1000000}})
            for (const int threads : {1, 2, 0})
              for (const bool timed : {false, true})
                expect(a, b,
                       with({.find = find, .limit = limit, .kinds = kinds, .threads = threads, .statistics = timed}));
}

TEST_P(WithBackend, CountsAreThereWithoutTimes) {
  const Mesh plane = test::mesh_of(scenes::bumpy_grid(30, 30));
  for (const auto find : {Options::Find::all, Options::Find::first})
    for (const double height : {0.0, 0.3, 40.0}) {
      Options options = with({.find = find, .threads = 1});
      const auto ask = [&] { return collide(plane, {}, plane, {.t = {0.5, 0.5, height}}, options)->statistics; };
      ask();  // makes the trees
      const Statistics plain = ask();
      options.statistics = true;
      const Statistics timed = ask();
      const auto counts = [](const Statistics& s) {
        return std::array{s.object_pairs, s.box_tests, s.leaf_pairs, s.triangle_pairs, s.element_tests, s.exact_calls};
      };
      EXPECT_EQ(counts(plain), counts(timed));
      EXPECT_EQ(plain.total_seconds + plain.hierarchy_seconds, 0);
    }
}

TEST_P(WithBackend, FirstContactIsCheaperThanAll) {
  const Mesh plane = test::mesh_of(scenes::flat_grid(100, 100));
  const Statistics all = collide(plane, {}, plane, {}, with({.threads = 1}))->statistics;
  const Statistics first =
      collide(plane, {}, plane, {}, with({.find = Options::Find::first, .threads = 1}))->statistics;
  EXPECT_LT(first.element_tests, all.element_tests / 20);
}

TEST_P(WithBackend, StopEndsAQueryWithoutAnAnswer) {
  std::stop_source source;
  source.request_stop();
  const Mesh cube = test::mesh_of(scenes::cube());
  for (const int threads : {1, 0}) {
    const Options options = with({.threads = threads, .stop = source.get_token()});
    const auto result = collide(cube, {}, cube, {}, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, Code::cancelled);
    EXPECT_EQ(test::scene_of(mixed_scene()).collide(options).error().code, Code::cancelled);
  }
}

TEST_P(WithBackend, ProgressCountsEachPairOfObjectsOnce) {
  const Scene scene = test::scene_of(mixed_scene());
  for (const int threads : {1, 0}) {
    Progress progress;
    const Contacts found = scene.collide(with({.threads = threads, .progress = &progress})).value();
    EXPECT_EQ(progress.total, found.statistics.object_pairs);
    EXPECT_EQ(progress.done, found.statistics.object_pairs);
    EXPECT_GE(found.statistics.object_pairs, found.objects.size());
  }
}

TEST_P(WithBackend, StatisticsAddUp) {
  const Mesh plane = test::mesh_of(scenes::bumpy_grid(30, 30));
  const Pose pose{.t = {0.5, 0.5, 0}};
  const Contacts found = collide(plane, {}, plane, pose, with({.threads = 1, .statistics = true})).value();
  const Statistics& s = found.statistics;
  EXPECT_EQ(s.object_pairs, 1u);
  EXPECT_GE(s.box_tests, s.leaf_pairs);
  EXPECT_GE(s.triangle_pairs, found.triangles.size());
  EXPECT_GE(s.element_tests, s.triangle_pairs / 2);
  EXPECT_GE(s.triangle_pairs, s.exact_calls);
  EXPECT_GT(s.nodes_built, 0u);
  EXPECT_GE(s.total_seconds, s.measured_seconds);  // on one thread
  EXPECT_GT(s.measured_seconds, 0);
}

/// What is kept in a file comes back, and what is no calibration is passed over.
TEST(Calibration, IsTextThatComesBack) {
  const std::string title = "impinge calibration 2\n";
  set_calibration(title + "device 1.0e-05 2.0e-09 3.0e-09 0.0e+00 1.0e-07 A device, of some driver 1.2\n");
  const std::string text = calibration();
  EXPECT_NE(text.find(" A device, of some driver 1.2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("2.000000e-09"), std::string::npos) << text;
  for (const std::string& other :
       {std::string(), std::string("nonsense"), std::string("impinge calibration 1\n1 1 1 1 1 B\n"), title + "1 2 3",
        title + "nan 1e-9 1e-9 0 0 B\n", title + "-1 1e-9 1e-9 0 0 B\n", title + "1e-5 0 1e-9 0 0 B\n",
        title + "1e-5 1e-9 1e300 0 0 B\n", title + std::string(5000, '\n'), title + std::string(3, '\0')})
    set_calibration(other);
  EXPECT_EQ(calibration(), text);
  set_calibration(text);
  EXPECT_EQ(calibration(), text);
}

TEST(Calibration, OfTheCpuComesBackToo) {
  const Mesh ball = test::mesh_of(scenes::bumpy_grid(4, 4));
  const auto box_test_seconds = [&] {
    return collide(ball, {}, ball, {}, {.backend = "simd", .predict_cost = true})->statistics.box_test_seconds;
  };
  box_test_seconds();  // measured
  const std::string before = calibration();
  std::string text = before;
  const std::size_t line = text.find("cpu "), name = text.find(" simd, ", line);
  ASSERT_NE(name, std::string::npos) << text;
  text.replace(line, name - line, "cpu 0 0 1e-9 2e-9 0.25 3e-9 4e-9 5e-9 6e-9 7e-9");
  set_calibration(text);
  EXPECT_EQ(box_test_seconds(), 0.25);
  set_calibration(before);
  EXPECT_LT(box_test_seconds(), 0.25);
}

}  // namespace
}  // namespace impinge
