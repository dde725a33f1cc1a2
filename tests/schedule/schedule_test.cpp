// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <memory>
#include <span>
#include <thread>
#include <utility>

#include "impinge/collide.hpp"
#include "scenes/shapes.hpp"
#include "schedule/cost.hpp"
#include "schedule/parallel.hpp"
#include "schedule/split.hpp"
#include "schedule/two_ended.hpp"
#include "schedule/ways.hpp"
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
TEST(Threads, RoundToNearest) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  const test::CallersMode mode(FE_UPWARD, true);
  std::atomic<int> wrong{0};
  const auto look = [&](auto&&...) { wrong += test::rounds_to_nearest_with_denormals() ? 0 : 1; };
  schedule::run_tasks(std::vector<int>(200, 4), 8, [&](int& depth, const auto& spawn) {
    look();
    if (depth > 0) spawn(depth - 1);
  });
  schedule::for_each(200, 8, look);
  EXPECT_EQ(wrong, 0);
  EXPECT_TRUE(mode.is_untouched());
}

void sleep_microseconds(int n) { std::this_thread::sleep_for(std::chrono::microseconds(n)); }

/// In an arena of 16 threads, which sleep, so that many are at work at once even on one core.
TEST(ForEach, RunsEachOnceOnNoMoreThreadsThanAsked) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 16);
  int most_of_all = 0;
  for (const int threads : {0, 1, 2, 3, 16, 1000})
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

TEST(Cost, IsEquationOneWithTermsForTheBroadPhaseTheGridAndExactArithmetic) {
  Statistics s;
  s.bounds_updated = 3, s.border_moves = 5, s.sphere_tests = 13, s.triangles_sorted = 17, s.object_pairs = 19;
  s.box_tests = 1000, s.element_tests = 200, s.nodes_built = 30, s.leaf_pairs = 7, s.exact_calls = 11;
  const schedule::CostConstants constants{.bounds_update = 1e-7,
                                          .border_move = 3e-7,
                                          .sphere_test = 2e-8,
                                          .object_pair = 6e-7,
                                          .box_test = 2e-7,
                                          .element_test = 5e-8,
                                          .node = 1e-5,
                                          .sorted_triangle = 4e-8,
                                          .leaf_pair = 3e-6,
                                          .exact_call = 4e-7};
  EXPECT_DOUBLE_EQ(schedule::predict_seconds(s, constants), 3 * 1e-7 + 5 * 3e-7 + 13 * 2e-8 + 1000 * 2e-7 + 200 * 5e-8 +
                                                                30 * 1e-5 + 17 * 4e-8 + 19 * 6e-7 + 7 * 3e-6 +
                                                                11 * 4e-7);
  s.broad_seconds = 16, s.hierarchy_seconds = 1, s.partition_seconds = 2, s.narrow_seconds = 4, s.exact_seconds = 8;
  s.results_seconds = 100, s.total_seconds = 100;
  EXPECT_DOUBLE_EQ(schedule::modelled_seconds(s), 31);
}

TEST(Cost, ConstantsAreReadOffRunsThatTheyWouldExplain) {
  const double box_test = 2e-6, element_test = 2e-5, leaf_pair = 3e-4, node = 1e-4, sorted_triangle = 4e-8;
  const auto runs = [&](std::uint64_t nodes, std::uint64_t triangles) {
    Statistics repeated;
    repeated.box_tests = 500, repeated.element_tests = 100, repeated.leaf_pairs = 20;
    repeated.hierarchy_seconds = 500 * box_test;
    repeated.narrow_seconds = 100 * element_test;
    repeated.partition_seconds = 20 * leaf_pair;
    Statistics building = repeated;
    building.nodes_built = nodes, building.triangles_sorted = triangles;
    building.hierarchy_seconds += static_cast<double>(nodes) * node + static_cast<double>(triangles) * sorted_triangle;
    return schedule::CostRuns{building, repeated};
  };
  Statistics touching;
  touching.exact_calls = 8, touching.exact_seconds = 2e-3;
  const schedule::CostRuns light = runs(10, 50000), deep = runs(400, 90000);
  const schedule::CostConstants c = schedule::constants_from(light, deep, touching);
  EXPECT_NEAR(c.box_test, box_test, 1e-12);
  EXPECT_NEAR(c.element_test, element_test, 1e-12);
  EXPECT_NEAR(c.leaf_pair, leaf_pair, 1e-12);
  EXPECT_NEAR(c.exact_call, 2e-3 / 8, 1e-12);
  EXPECT_NEAR(c.node, node, 1e-12);
  EXPECT_NEAR(c.sorted_triangle, sorted_triangle, 1e-12);
  // Runs that noise has made contradict each other give constants that are not negative, and explain both together.
  schedule::CostRuns noisy = light;
  noisy.building.hierarchy_seconds *= 100;
  for (const schedule::CostConstants& odd :
       {schedule::constants_from(noisy, deep, touching), schedule::constants_from(light, runs(400, 0), touching),
        schedule::constants_from({}, {}, {})}) {
    EXPECT_GE(odd.node, 0);
    EXPECT_GE(odd.sorted_triangle, 0);
  }
}

TEST(Cost, IsPredictedWhenAskedFor) {
  const Mesh ball = test::mesh_of(scenes::uv_sphere(32, 32));
  const Pose pose{.t = {1.5, 0, 0}};
  const Statistics plain = collide(ball, {}, ball, pose)->statistics;
  EXPECT_EQ(plain.predicted_seconds, 0);
  EXPECT_EQ(plain.box_test_seconds, 0);
  const Statistics s = collide(ball, {}, ball, pose, {.predict_cost = true})->statistics;
  double sum = 0;
  for (const schedule::CostTerm& term : schedule::kCostTerms) {
    EXPECT_TRUE(std::isfinite(s.*term.seconds));
    sum += static_cast<double>(s.*term.count) * s.*term.seconds;
  }
  for (const auto constant : {&Statistics::box_test_seconds, &Statistics::element_test_seconds,
                              &Statistics::leaf_pair_seconds, &Statistics::exact_call_seconds})
    EXPECT_GT(s.*constant, 0);
  EXPECT_GT(s.node_seconds + s.sorted_triangle_seconds, 0);
  EXPECT_DOUBLE_EQ(s.predicted_seconds, sum);
  EXPECT_DOUBLE_EQ(s.measured_seconds, schedule::modelled_seconds(s));
  EXPECT_GT(s.total_seconds, 0);
}

/// The constants that depend on the leaf size, in ns, of one run of bench_cost.
struct OfLeafSize {
  std::uint32_t leaf_size;
  double box_test, element_test, node, sorted_triangle, leaf_pair;
};
constexpr OfLeafSize kSimd[] = {{4, 1.95, 6.16, 1049, 17.2, 83.7},
                                {16, 2.47, 6.15, 1004, 17.5, 82.6},
                                {32, 2.34, 6.00, 0, 22.5, 144},
                                {64, 3.32, 6.14, 0, 22.4, 306}};
constexpr OfLeafSize kPaper[] = {{4, 49.1, 39.3, 237, 27.3, 696},
                                 {16, 49.8, 38.6, 636, 27.2, 2379},
                                 {32, 50.2, 38.9, 1328, 27.1, 3865},
                                 {128, 54.9, 40.9, 11313, 25.6, 12994}};

/// T of two copies of a mesh, by what a walk counts: of the first question, and of the same again.
struct Costs {
  double first, again;
  Statistics counts;  ///< of the latter
};
Costs costs(const scenes::MeshData& data, const Pose& pose, std::uint32_t leaf_size, std::string_view backend,
            const OfLeafSize& constants) {
  const Mesh mesh = test::mesh_of(data, leaf_size);
  const auto ask = [&] { return collide(mesh, {}, mesh, pose, {.threads = 1, .backend = backend})->statistics; };
  const auto t = [&](const Statistics& s) {
    return schedule::predict_seconds(s, {.box_test = constants.box_test,
                                         .element_test = constants.element_test,
                                         .node = constants.node,
                                         .sorted_triangle = constants.sorted_triangle,
                                         .leaf_pair = constants.leaf_pair});
  };
  const Statistics first = ask(), again = ask();
  EXPECT_GT(first.nodes_built, again.nodes_built);
  return {t(first), t(again), again};
}

/// Within a tenth, of a question that finds the trees made.
TEST(Cost, IsLeastAtTheLeafSizesThatAreTaken) {
  const auto expect_least = [](std::string_view backend, std::span<const OfLeafSize> sizes, const OfLeafSize& taken) {
    const scenes::MeshData knot = scenes::torus_knot_of(9612);
    for (const Pose& pose : {Pose{.t = {0.3, 0.2, 0.1}}, Pose{.t = {3, 1, 1}}}) {
      const Costs own = costs(knot, pose, 0, backend, taken);
      EXPECT_GT(own.counts.leaf_pairs, 10u);
      for (const OfLeafSize& size : sizes) {
        const Costs other = costs(knot, pose, size.leaf_size, backend, size);
        EXPECT_LT(own.again, 1.1 * other.again) << backend << ", leaf size " << size.leaf_size;
        EXPECT_EQ(own.counts.box_tests == other.counts.box_tests, size.leaf_size == taken.leaf_size);
      }
    }
  };
  expect_least("simd", kSimd, kSimd[1]);
  expect_least("paper", kPaper, kPaper[0]);
}

/// The paper's way makes no tree of a mesh whose triangles are sooner tested, as one leaf.
TEST(Cost, IsLeastWhereSmallMeshesAreTestedDirectly) {
  const Pose pose{.t = {1.2, 0.9, 0.7}};
  for (const auto& [stacks, size] : {std::pair(3, kPaper[2]), std::pair(9, kPaper[3])}) {
    const scenes::MeshData sphere = scenes::uv_sphere(8, stacks);
    const Costs direct = costs(sphere, pose, 0, "paper", size), tree = costs(sphere, pose, 4, "paper", kPaper[0]);
    EXPECT_EQ(direct.counts.leaf_pairs, 1u);
    EXPECT_GT(tree.counts.leaf_pairs, 1u);
    EXPECT_LT(direct.first, tree.first) << stacks;
    EXPECT_LT(direct.again, tree.again) << stacks;
  }
  EXPECT_GT(costs(scenes::uv_sphere(8, 17), pose, 0, "paper", kPaper[0]).counts.leaf_pairs, 1u);
}

TEST(Concurrency, IsNoMoreThanThereIs) {
  const auto most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  EXPECT_EQ(schedule::concurrency(1), 1);
  EXPECT_EQ(schedule::concurrency(1'000'000), static_cast<int>(most));
}

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
    for (int t = 0; t < 8; ++t)
      threads.emplace_back([&, t] {
        for (bool done = false; !done;) {
          const auto range = t % 2 == 0 ? row.take_front(1 + t) : row.take_back(1 + t);
          for (std::size_t i = range.begin; i < range.end; ++i) ++times[i];
          done = range.empty();
        }
      });
  }
  for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(times[i], 1);
}

/// Both sides end together, and where asking takes longer than the CPU alone the device gets nothing.
TEST(DevicePortion, EndsWhenTheCpuDoes) {
  for (const double left : {1.0, 100.0, 1e6}) {
    for (const double device : {0.1, 1.0, 50.0})
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
  EXPECT_EQ(schedule::device_portion(100, {.cpu = 0, .device = 1, .question = 0}), 0);
  EXPECT_EQ(schedule::device_portion(100, {.cpu = 1, .device = 0, .question = 0}), 0);
}

/// When both sides of a hybrid query end, on clocks of their own: the CPU's threads do a weight of 1 a second each, and
/// the device takes the time that it is told to.
struct Ends {
  double cpu = 0, device = 0, device_weight = 0;
};
struct Race {
  double device_speed, question;
  int threads = 1;
  double misjudged = 1;  ///< the speed that the cost function predicts over the true one
};
Ends run(const Race& race, const std::vector<double>& weights) {
  schedule::TwoEnded row(weights);
  schedule::DevicePortions portions(race.misjudged * race.device_speed / race.threads, race.question, 0);
  std::vector<std::pair<double, double>> finished;  // when, and what it weighed
  std::vector<double> free(static_cast<std::size_t>(race.threads));
  double device_free = 0;
  bool is_device_over = false;
  Ends ends;
  while (!free.empty() || !is_device_over) {
    const auto next = std::min_element(free.begin(), free.end());
    if (next != free.end() && (is_device_over || *next <= device_free)) {
      const auto range = row.take_back(schedule::cpu_portion(row.left(), race.threads));
      if (range.empty()) {
        free.erase(next);
        continue;
      }
      ends.cpu = std::max(ends.cpu, *next += range.weight);
      finished.emplace_back(*next, range.weight);
      continue;
    }
    double cpu_done = 0;
    for (const auto& [when, weight] : finished) cpu_done += when <= device_free ? weight : 0;
    if (row.left() == 0) {
      is_device_over = true;
    } else if (portions.is_early(cpu_done, device_free)) {
      device_free += 5e-5;
    } else {
      const auto range = row.take_front(portions.next(row.left(), cpu_done, device_free));
      const double seconds = race.question + range.weight / race.device_speed;
      is_device_over = range.empty();
      if (is_device_over) continue;
      ends.device = device_free += seconds;
      ends.device_weight += range.weight;
      portions.done(range.weight, seconds);
    }
  }
  return ends;
}

void expect_together(const Race& race, const std::vector<double>& weights) {
  const Ends ends = run(race, weights);
  EXPECT_LT(std::abs(ends.cpu - ends.device), 0.1 * std::max(ends.cpu, ends.device))
      << race.device_speed << ' ' << race.misjudged << ' ' << race.threads << ' ' << race.question << ": " << ends.cpu
      << ' ' << ends.device;
}

TEST(DevicePortions, LetBothSidesEndTogether) {
  test::Seeded seeded(5);
  for (const double speed : {1 / 20.0, 1 / 5.0, 1 / 2.0, 1.0, 2.0, 5.0, 20.0})
    for (const double misjudged : {0.5, 1.0, 2.0}) {
      for (const int threads : {1, 2})  // more share single pieces with each other, too
        for (const double question : {0.0, 2e-4}) {
          std::vector<double> weights(1024);  // a second of one thread's work
          for (double& weight : weights) weight = seeded.random.integer(1, 10) / (5.5 * 1024);
          expect_together({speed * threads, question, threads, misjudged}, weights);
        }
    }
  // As many pieces as one pair of objects is cut into.
  for (const double speed : {1 / 20.0, 1.0, 20.0})
    expect_together({speed, 2e-4, 1, 1}, std::vector<double>(256, 1 / 256.0));
}

TEST(DevicePortions, AreNoneWhereADeviceGainsNothing) {
  const std::vector<double> weights(1024, 1 / 1024.0);
  EXPECT_EQ(run({.device_speed = 20, .question = 2}, weights).device_weight, 0);
  EXPECT_GT(run({.device_speed = 20, .question = 0.1}, weights).device_weight, 0.5);
}

/// Whatever the cost function expects, within a factor of 2, soon each query goes the way that takes least, and does so
/// again when that changes.
TEST(Ways, AreTheQuickest) {
  test::Seeded seeded(7);
  const auto random_seconds = [&] {
    return schedule::WaySeconds{seeded.random.uniform(1, 9), seeded.random.uniform(1, 9), seeded.random.uniform(1, 9)};
  };
  for (int scene = 0; scene < 200; ++scene) {
    schedule::Ways ways;
    for (const int queries : {20, 4000}) {
      const schedule::WaySeconds truth = random_seconds();
      const double least = *std::min_element(truth.begin(), truth.end());
      schedule::WaySeconds expected{};
      for (std::size_t i = 0; i < schedule::kWays; ++i) expected[i] = truth[i] * seeded.random.uniform(0.5, 2);
      std::array<std::uint64_t, schedule::kWays> tests{};  // some ways do many needless ones
      for (std::uint64_t& number : tests) number = static_cast<std::uint64_t>(seeded.random.integer(1, 100)) * 100'000;
      double late = 0;  // in the second half
      for (int query = 0; query < queries; ++query) {
        const schedule::Way way = ways.quickest(expected);
        const double seconds = truth[static_cast<std::size_t>(way)] * seeded.random.uniform(1, 1.01);
        if (query >= queries / 2) late += seconds;
        ways.add(way, {.box_tests = tests[static_cast<std::size_t>(way)]}, seconds, true);
      }
      EXPECT_LE(late / (queries - queries / 2), 1.05 * least);
    }
  }
}

/// Not even when it has been forgotten for long.
TEST(Ways, AreTriedOnceIfFarSlower) {
  schedule::Ways ways;
  const schedule::WaySeconds expected{1, 1, 1}, truth{1, 1.5, 1000};
  int slow = 0;
  for (int query = 0; query < 20'000; ++query) {
    const schedule::Way way = ways.quickest(expected);
    slow += way == schedule::Way::device ? 1 : 0;
    ways.add(way, {}, truth[static_cast<std::size_t>(way)], true);
  }
  EXPECT_EQ(slow, 1);
}

/// A query that made a tree or uploaded a mesh says nothing of the next.
TEST(Ways, ForgetWhatIsDoneOnlyOnce) {
  schedule::Ways ways;
  EXPECT_TRUE(ways.is_empty());
  ways.add(schedule::Way::device, {.box_tests = 1000}, 5, false);
  EXPECT_FALSE(ways.is_empty());
  EXPECT_EQ(ways.last_seconds(), 5);
  EXPECT_EQ(ways.seconds(schedule::Way::device, {3, 2, 1}), 1);
  EXPECT_EQ(ways.quickest({3, 2, 1}), schedule::Way::device);
}

}  // namespace
}  // namespace impinge
