// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/workspace.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <functional>
#include <numeric>
#include <thread>

#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"
#include "schedule/parallel.hpp"
#include "tests/core/support.hpp"
#include "tests/pipeline/crowd.hpp"

namespace impinge {
namespace {

/// A question, and its answer without a workspace of one's own.
struct WorkspaceQuestion {
  std::function<Result<Contacts>(Workspace*)> ask;
  std::optional<Contacts> answer;  ///< none: an error
  Code code{};
};

WorkspaceQuestion question(std::function<Result<Contacts>(Workspace*)> ask) {
  WorkspaceQuestion q{std::move(ask), std::nullopt, {}};
  std::thread([&] {  // with memory that nothing else has used
    auto result = q.ask(nullptr);
    if (result) {
      q.answer = *std::move(result);
    } else {
      q.code = result.error().code;
    }
  })
      .join();
  return q;
}

void expect_answer(const WorkspaceQuestion& q, Workspace* workspace) {
  const auto found = q.ask(workspace);
  ASSERT_EQ(found.has_value(), q.answer.has_value());
  if (found) {
    test::expect_same(*q.answer, *found);
  } else {
    EXPECT_EQ(found.error().code, q.code);
  }
}

/// Large and small, of every backend and kind, with answers, without, and with errors.
std::vector<WorkspaceQuestion> all_questions() {
  std::vector<WorkspaceQuestion> questions;
  scenes::Random random(1);
  const auto scene = std::make_shared<Scene>(test::scene_of(test::crowd(1)));
  const auto few = std::make_shared<Scene>(test::scene_of(scenes::flush_boxes(2, 2, 1)));
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968)), cube = test::mesh_of(scenes::cube(), 1);
  const Mesh plane = test::mesh_of(scenes::flat_grid(30, 30)), empty = test::mesh_of({});
  const Pose pose = scenes::random_motion(random, 0.5), far{.t = {50, 0, 0}}, outside{.t = {0x1p301, 0, 0}};
  std::stop_source stopped;
  stopped.request_stop();
  for (const char* backend : {"simd", "paper", "auto"})
    for (const int threads : {1, 2}) {
      const Options plain{.threads = threads, .backend = backend};
      Options first = plain, limited = plain, touching = plain, stop = plain;
      first.find = Options::Find::first;
      limited.limit = 17;
      touching.kinds = kTouching;
      stop.stop = stopped.get_token();
      for (const Options& options : {plain, first, limited, touching, stop}) {
        // Which witness `first` finds is open with several threads.
        if (options.find == Options::Find::first && threads != 1) continue;
        questions.push_back(question([=](Workspace* w) { return scene->collide(options, w); }));
        questions.push_back(question([=](Workspace* w) { return few->collide(options, w); }));
        questions.push_back(question([=](Workspace* w) { return collide(knot, {}, knot, pose, options, w); }));
        questions.push_back(question([=](Workspace* w) { return collide(plane, {}, plane, {}, options, w); }));
        questions.push_back(question([=](Workspace* w) {
          const std::array poses{Pose{}, far, pose};
          return collide_poses(cube, {poses.data(), 1}, knot, poses, options, w);
        }));
      }
      questions.push_back(question([=](Workspace* w) { return collide(cube, {}, cube, far, plain, w); }));
      questions.push_back(question([=](Workspace* w) { return collide(empty, {}, cube, {}, plain, w); }));
      questions.push_back(question([=](Workspace* w) { return collide(cube, {}, cube, outside, plain, w); }));
    }
  questions.push_back(question([=](Workspace* w) { return collide(cube, {}, cube, {}, {.threads = -1}, w); }));
  return questions;
}

TEST(Workspace, ServesAnySeriesOfQuestions) {
  const std::vector<WorkspaceQuestion> questions = all_questions();
  for (std::uint64_t seed = 1; seed <= 3u; ++seed) {
    test::Seeded seeded(seed);
    std::array<Workspace, 2> workspaces;
    for (int i = 0; i < 300; ++i) {
      const auto& q =
          questions[static_cast<std::size_t>(seeded.random.integer(0, static_cast<int>(questions.size()) - 1))];
      Workspace& workspace = workspaces[static_cast<std::size_t>(seeded.random.integer(0, 1))];
      expect_answer(q, seeded.random.integer(0, 9) == 0 ? nullptr : &workspace);
      if (testing::Test::HasFailure()) return;
      if (q.answer && seeded.random.integer(0, 1) == 0) workspace.recycle(Contacts(*q.answer));  // any answer will do
    }
  }
}

/// What is recycled is memory, whatever stands in it.
TEST(Workspace, TakesAnyContactsForTheirMemory) {
  const Mesh cube = test::mesh_of(scenes::cube());
  for (int round = 0; round < 4; ++round) {
    const Options options{.find = round < 2 ? Options::Find::all : Options::Find::first, .threads = 1};
    const Contacts expected = collide(cube, {}, cube, {}, options).value();
    Workspace workspace;
    Contacts junk;
    if (round % 2 == 1) {
      junk.objects.assign(1000, {7, 8});
      junk.offsets.assign(3, 99);
      junk.triangles.assign(5, {1, 2});
      junk.kinds.assign(70, Kind::coplanar);
      junk.truncated = true;
      junk.hash = 42;
      junk.statistics.element_tests = 1000000;
    } else {
      junk.offsets.clear();
    }
    workspace.recycle(std::move(junk));
    const Contacts found = collide(cube, {}, cube, {}, options, &workspace).value();
    test::expect_same(expected, found);
    EXPECT_EQ(found.statistics.element_tests, expected.statistics.element_tests);
  }
}

TEST(Workspace, LeavesItsAnswersToThemselves) {
  const Mesh cube = test::mesh_of(scenes::cube()), plane = test::mesh_of(scenes::flat_grid(10, 10));
  const Contacts expected = collide(cube, {}, cube, {}).value();
  std::optional<Workspace> workspace(std::in_place);
  const Contacts kept = collide(cube, {}, cube, {}, {}, &*workspace).value();
  EXPECT_FALSE(collide(plane, {}, plane, {}, {}, &*workspace)->triangles.empty());
  test::expect_same(expected, kept);
  workspace.reset();
  test::expect_same(expected, kept);
}

/// Meshes come and go, at the same addresses perhaps; a workspace knows none of them from before.
TEST(Workspace, RemembersNoMesh) {
  Workspace workspace;
  test::Seeded seeded(4);
  for (int i = 0; i < 200; ++i) {
    const auto soup = [&] { return scenes::integer_soup(seeded.random, 12, 2); };
    const scenes::PlacedScene scene = scenes::pair_scene(soup(), soup());
    const Options options{.threads = 1, .backend = i % 3 == 0 ? "paper" : "simd"};
    const std::vector<Mesh> meshes = test::meshes_of(scene, 4);
    ASSERT_EQ(test::listed(collide(meshes[0], {}, meshes[1], {}, options, &workspace).value()),
              test::brute_force(scene));
  }
}

TEST(Workspace, MayBeMoved) {
  const Mesh cube = test::mesh_of(scenes::cube());
  const Contacts expected = collide(cube, {}, cube, {}).value();
  Workspace first;
  test::expect_same(expected, collide(cube, {}, cube, {}, {}, &first).value());
  Workspace second(std::move(first));
  test::expect_same(expected, collide(cube, {}, cube, {}, {}, &second).value());
  first = Workspace();
  test::expect_same(expected, collide(cube, {}, cube, {}, {}, &first).value());
  first = std::move(second);
  test::expect_same(expected, collide(cube, {}, cube, {}, {}, &first).value());
}

/// Each of the caller's threads with one of its own, or with none, while queries wait for each other's tasks and take
/// up others meanwhile.
TEST(Workspace, ServesQueriesWithinQueries) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968)), cube = test::mesh_of(scenes::cube());
  const Pose pose{.t = {0.7, 0.2, 0.1}};
  const Contacts large = collide(knot, {}, knot, pose, {.threads = 1}).value();
  const Contacts small = collide(cube, {}, knot, pose, {.threads = 1}).value();
  EXPECT_FALSE(small.triangles.empty());
  std::vector<Workspace> workspaces(64);
  std::vector<std::optional<Contacts>> found(workspaces.size());
  std::vector<std::size_t> numbers(found.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  schedule::run_tasks(std::move(numbers), 0, [&](std::size_t i, const auto&) {
    Workspace* const workspace = i % 3 == 0 ? &workspaces[i] : nullptr;
    const Options options{.threads = i % 4 == 1 ? 1 : 0, .backend = i % 5 == 0 ? "paper" : "simd"};
    const auto result = collide(i % 2 == 0 ? knot : cube, {}, knot, pose, options, workspace);
    if (result) found[i] = *result;
  });
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_TRUE(found[i]);
    test::expect_same(i % 2 == 0 ? large : small, *found[i]);
  }
}

}  // namespace
}  // namespace impinge
