// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The smallest parts alone: predicates, boxes, points, the broad phase.
#include "bench/micro.hpp"

#include <benchmark/benchmark.h>

#include <map>

#include "bench/support.hpp"

namespace impinge::bench {
namespace {

/// Collects the repeats of each benchmark.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.error_occurred) fail(run.benchmark_name() + ": " + run.error_message);
      if (run.run_type != Run::RT_Iteration) continue;
      const std::string name = run.run_name.function_name;
      if (!results_.contains(name)) names_.push_back(name);
      results_[name].unit = run.time_unit;
      results_[name].seconds.push_back(1 / run.counters.at("items_per_second").value);
    }
  }

  /// The benchmarks whose unit is this one.
  [[nodiscard]] Table table(benchmark::TimeUnit unit) const {
    const std::string unit_name = benchmark::GetTimeUnitString(unit);
    Table table({"what", unit_name + " an item", "lowest", "highest", "repeats"});
    for (const std::string& name : names_) {
      const Result& result = results_.at(name);
      if (result.unit != unit) continue;
      const double scale = benchmark::GetTimeUnitMultiplier(unit);
      const Spread s = spread(result.seconds);
      table.add({name, digits(scale * s.median), digits(scale * s.low), digits(scale * s.high),
                 count(result.seconds.size())});
    }
    return table;
  }

 private:
  struct Result {
    benchmark::TimeUnit unit = benchmark::kNanosecond;
    std::vector<double> seconds;
  };
  std::vector<std::string> names_;  // in order
  std::map<std::string, Result> results_;
};

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  std::vector<std::string> flags{"bench_micro",
                                 arguments.quick ? "--benchmark_min_time=0.02" : "--benchmark_min_time=0.04",
                                 arguments.quick ? "--benchmark_repetitions=3" : "--benchmark_repetitions=5"};
  std::vector<char*> argv;
  for (std::string& flag : flags) argv.push_back(flag.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
  register_exact_benchmarks();
  register_box_benchmarks();
  register_point_benchmarks(arguments.quick ? 100'000 : 1'000'000);
  register_broad_benchmarks(arguments.quick ? 20'000 : 100'000);
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  benchmark::Shutdown();
  collector.table(benchmark::kNanosecond).write(arguments.folder, "micro");
  collector.table(benchmark::kMillisecond).write(arguments.folder, "broad");
  border_moves(arguments.quick ? 10 : 50).write(arguments.folder, "border_moves");
}

}  // namespace impinge::bench
