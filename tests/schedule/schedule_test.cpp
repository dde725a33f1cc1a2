// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <memory>
#include <thread>

#include "impinge/collide.hpp"
#include "impinge/devices.hpp"
#include "scenes/shapes.hpp"
#include "schedule/cost.hpp"
#include "schedule/parallel.hpp"
#include "schedule/split.hpp"
#include "schedule/two_ended.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

/// A task is a range that is halved until it is short; both halves may be empty only where the whole was.
struct Range {
  std::uint32_t from, to;
};

TEST(RunTasks, RunsEachTaskAndWhatItSpawnsOnce) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 16);
  constexpr std::uint32_t n = 20000;
  for (const int threads : {0, 1, 2, 3, 5, 8, 16, 1000}) {
    SCOPED_TRACE(std::to_string(threads) + " threads");
    const auto times = std::make_unique<std::atomic<int>[]>(n);
    tbb::enumerable_thread_specific<std::uint64_t> counts([] { return std::uint64_t{0}; });
    std::vector<Range> tasks;
    for (std::uint32_t i = 0; i < n; i += 100) tasks.push_back({i, i + 100});
    schedule::run_tasks(std::move(tasks), threads, [&](Range& range, const auto& spawn) {
      while (range.to - range.from > 3) {
        const std::uint32_t middle = range.from + (range.to - range.from) / 2;
        spawn(Range{middle, range.to});
        range.to = middle;
      }
      for (std::uint32_t i = range.from; i < range.to; ++i) times[i].fetch_add(1);
      counts.local() += range.to - range.from;
    });
    std::uint64_t total = 0;
    for (const std::uint64_t count : counts) total += count;
    EXPECT_EQ(total, n);
    for (std::uint32_t i = 0; i < n; ++i) ASSERT_EQ(times[i], 1);
  }
}

TEST(RunTasks, OneThreadIsTheCallers) {
  const std::thread::id caller = std::this_thread::get_id();
  schedule::run_tasks(std::vector<int>{5, 3}, 1, [&](int& depth, const auto& spawn) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    if (depth > 0) spawn(depth - 1);
  });
}

TEST(RunTasks, CopesWithNothingToDo) {
  for (const int threads : {1, 2, 0})
    schedule::run_tasks(std::vector<int>{}, threads, [](int&, const auto&) { ADD_FAILURE(); });
}

/// Contract 3.2, on the workers too.
TEST(RunTasks, EachTaskRoundsToNearest) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  const test::CallersMode mode(FE_UPWARD, true);
  std::atomic<int> wrong{0};
  schedule::run_tasks(std::vector<int>(200, 4), 8, [&](int& depth, const auto& spawn) {
    if (!test::rounds_to_nearest_with_denormals()) ++wrong;
    if (depth > 0) spawn(depth - 1);
  });
  EXPECT_EQ(wrong, 0);
  EXPECT_TRUE(mode.is_untouched());
}

void sleep_microseconds(int n) { std::this_thread::sleep_for(std::chrono::microseconds(n)); }

/// In an arena of 16 threads, which sleep, so that many are at work at once even on one core.
TEST(ForEach, RunsEachOnceOnNoMoreThreadsThanAsked) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 16);
  int most_of_all = 0;
  for (const int threads : {0, 1, 2, 3, 16, 1000}) {
    for (const std::size_t n : {0, 1, 2, 5, 100}) {
      SCOPED_TRACE(std::to_string(n) + " by " + std::to_string(threads) + " threads");
      const auto times = std::make_unique<std::atomic<int>[]>(n);
      std::atomic<int> at_work{0}, most{0};
      schedule::arena_of(16).execute([&] {
        schedule::for_each(n, threads, [&](std::size_t i) {
          const int now = ++at_work;
          for (int before = most; before < now && !most.compare_exchange_weak(before, now);) {
          }
          sleep_microseconds(500);
          times[i].fetch_add(1);
          --at_work;
        });
      });
      for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(times[i], 1);
      EXPECT_LE(most, threads == 0 ? 16 : threads);
      most_of_all = std::max<int>(most_of_all, most);
    }
  }
  EXPECT_GT(most_of_all, 3);  // else nothing has been tried
}

TEST(ForEach, PassesAnExceptionOn) {
  for (const int threads : {0, 1, 2}) {
    const auto fails = [](std::size_t i) {
      if (i == 7) throw std::bad_alloc();
    };
    EXPECT_THROW(schedule::for_each(100, threads, fails), std::bad_alloc);
  }
}

/// Its caller may hold what another task waits for, so meanwhile it must not take up that one.
TEST(ForEach, KeepsItsCallersThreadFromOtherTasks) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  std::atomic<int> wrong{0};
  tbb::enumerable_thread_specific<bool> is_waiting([] { return false; });
  schedule::run_tasks(std::vector<int>(200, 0), 8, [&](int, const auto&) {
    if (is_waiting.local()) ++wrong;
    is_waiting.local() = true;
    // One is long, for which the caller has to wait if another thread has it.
    schedule::for_each(8, 8, [](std::size_t i) { sleep_microseconds(i == 0 ? 3000 : 100); });
    is_waiting.local() = false;
  });
  EXPECT_EQ(wrong, 0);
}

TEST(ForEach, RoundsToNearest) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  const test::CallersMode mode(FE_UPWARD, true);
  std::atomic<int> wrong{0};
  schedule::for_each(200, 8, [&](std::size_t) {
    if (!test::rounds_to_nearest_with_denormals()) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
  EXPECT_TRUE(mode.is_untouched());
}

TEST(Cost, IsEquationOneWithTermsForTheGridAndExactArithmetic) {
  Statistics s;
  s.box_tests = 1000, s.element_tests = 200, s.nodes_built = 30, s.leaf_pairs = 7, s.exact_calls = 11;
  EXPECT_DOUBLE_EQ(schedule::predict_seconds(s, {2e-7, 5e-8, 1e-5, 3e-6, 4e-7}),
                   1000 * 2e-7 + 200 * 5e-8 + 30 * 1e-5 + 7 * 3e-6 + 11 * 4e-7);
  s.hierarchy_seconds = 1, s.partition_seconds = 2, s.narrow_seconds = 4, s.exact_seconds = 8;
  s.broad_seconds = 100, s.results_seconds = 100, s.total_seconds = 100;
  EXPECT_DOUBLE_EQ(schedule::modelled_seconds(s), 15);
}

TEST(Cost, ConstantsExplainTheRunsTheyWereReadFrom) {
  Statistics building, repeated, touching;
  repeated.box_tests = building.box_tests = 500;
  repeated.element_tests = building.element_tests = 100;
  repeated.hierarchy_seconds = 1e-3, building.hierarchy_seconds = 5e-3;
  repeated.narrow_seconds = building.narrow_seconds = 2e-3;
  repeated.exact_seconds = building.exact_seconds = 1e-3;
  building.nodes_built = 40;
  repeated.leaf_pairs = building.leaf_pairs = 20;
  repeated.partition_seconds = building.partition_seconds = 6e-3;
  repeated.exact_calls = building.exact_calls = 4;
  touching.exact_calls = 8, touching.exact_seconds = 2e-3;
  const schedule::CostConstants c = schedule::constants_from(building, repeated, touching);
  EXPECT_DOUBLE_EQ(c.box_test, 1e-3 / 500);
  EXPECT_DOUBLE_EQ(c.element_test, 2e-3 / 100);
  EXPECT_DOUBLE_EQ(c.node, 4e-3 / 40);
  EXPECT_DOUBLE_EQ(c.leaf_pair, 6e-3 / 20);
  EXPECT_DOUBLE_EQ(c.exact_call, 2e-3 / 8);
  for (const Statistics& s : {building, repeated})
    EXPECT_NEAR(schedule::predict_seconds(s, c), schedule::modelled_seconds(s), 1e-12);
  const schedule::CostConstants none = schedule::constants_from({}, {}, {});
  EXPECT_EQ(none.box_test + none.element_test + none.node + none.leaf_pair + none.exact_call, 0);
}

TEST(Cost, IsPredictedWhenAskedFor) {
  const Mesh ball = test::mesh_of(scenes::uv_sphere(32, 32));
  Pose pose;
  pose.t = {1.5, 0, 0};
  const Statistics plain = collide(ball, {}, ball, pose)->statistics;
  EXPECT_EQ(plain.predicted_seconds, 0);
  EXPECT_EQ(plain.box_test_seconds, 0);
  const Statistics s = collide(ball, {}, ball, pose, {.predict_cost = true})->statistics;
  EXPECT_GT(s.box_test_seconds, 0);
  EXPECT_GT(s.element_test_seconds, 0);
  EXPECT_GT(s.node_seconds, 0);
  EXPECT_GT(s.leaf_pair_seconds, 0);
  EXPECT_GT(s.exact_call_seconds, 0);
  EXPECT_DOUBLE_EQ(s.predicted_seconds,
                   schedule::predict_seconds(s, {s.box_test_seconds, s.element_test_seconds, s.node_seconds,
                                                 s.leaf_pair_seconds, s.exact_call_seconds}));
  EXPECT_DOUBLE_EQ(s.measured_seconds, schedule::modelled_seconds(s));
  EXPECT_GT(s.total_seconds, 0);
}

// --- the split between CPU and device
// ------------------------------------------------------------------------------------

TEST(TwoEnded, GivesEachPieceOnceFromEitherEnd) {
  schedule::TwoEnded row({1, 2, 3, 4, 5});
  EXPECT_EQ(row.total(), 15);
  EXPECT_TRUE(row.take_front(0).empty());
  EXPECT_TRUE(row.take_back(-1).empty());
  const auto front = row.take_front(2.5), back = row.take_back(5);
  EXPECT_EQ(front.begin, 0u);
  EXPECT_EQ(front.end, 2u);
  EXPECT_EQ(front.weight, 3);
  EXPECT_EQ(back.begin, 4u);
  EXPECT_EQ(back.end, 5u);
  EXPECT_EQ(back.weight, 5);
  EXPECT_EQ(row.left(), 7);
  const auto rest = row.take_back(100);
  EXPECT_EQ(rest.begin, 2u);
  EXPECT_EQ(rest.end, 4u);
  EXPECT_EQ(rest.weight, 7);
  EXPECT_EQ(row.left(), 0);
  EXPECT_TRUE(row.take_front(1).empty());
  EXPECT_TRUE(schedule::TwoEnded({}).take_front(1).empty());
}

TEST(TwoEnded, GivesEachPieceOnceToManyThreads) {
  constexpr std::size_t n = 20000;
  schedule::TwoEnded row(std::vector<double>(n, 1.0));
  const auto times = std::make_unique<std::atomic<int>[]>(n);
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 8; ++t) {
      threads.emplace_back([&, t] {
        for (bool done = false; !done;) {
          const auto range = t % 2 == 0 ? row.take_front(1 + t) : row.take_back(1 + t);
          for (std::size_t i = range.begin; i < range.end; ++i) ++times[i];
          done = range.empty();
        }
      });
    }
  }
  for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(times[i], 1);
}

/// Both sides end together, and where asking takes longer than the CPU alone the device gets nothing.
TEST(DevicePortion, EndsWhenTheCpuDoes) {
  for (const double left : {1.0, 100.0, 1e6}) {
    for (const double device : {0.1, 1.0, 50.0}) {
      for (const double question : {0.0, 0.01, 10.0}) {
        const schedule::Speeds speeds{.cpu = 2, .device = device, .question = question};
        const double x = schedule::device_portion(left, speeds);
        EXPECT_GE(x, 0);
        EXPECT_LE(x, left);
        if (x > 0) {
          EXPECT_NEAR(question + x / device, (left - x) / 2, 1e-9 * left);
        } else {
          EXPECT_GE(question, left / 2);
        }
      }
    }
  }
  EXPECT_EQ(schedule::device_portion(100, {.cpu = 0, .device = 1, .question = 0}), 0);
  EXPECT_EQ(schedule::device_portion(100, {.cpu = 1, .device = 0, .question = 0}), 0);
}

/// What is kept in a file comes back, and what is no calibration is passed over.
TEST(Calibration, IsTextThatComesBack) {
  const std::string title = "impinge calibration 1\n";
  set_calibration(title + "1.0e-05 2.0e-09 3.0e-09 0.0e+00 1.0e-07 A device, of some driver 1.2\n");
  const std::string text = calibration();
  EXPECT_NE(text.find(" A device, of some driver 1.2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("2.000000e-09"), std::string::npos) << text;
  for (const std::string& other :
       {std::string(), std::string("nonsense"), std::string("impinge calibration 2\n1 1 1 1 1 B\n"), title + "1 2 3",
        title + "nan 1e-9 1e-9 0 0 B\n", title + "-1 1e-9 1e-9 0 0 B\n", title + "1e-5 0 1e-9 0 0 B\n",
        title + "1e-5 1e-9 1e300 0 0 B\n", title + std::string(5000, '\n'), title + std::string(3, '\0')})
    set_calibration(other);
  EXPECT_EQ(calibration(), text);
  set_calibration(text);
  EXPECT_EQ(calibration(), text);
}

}  // namespace
}  // namespace impinge
