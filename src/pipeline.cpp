// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline.hpp"

#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "broad/all_pairs.hpp"
#include "calibration.hpp"
#include "exact/decide.hpp"
#include "hierarchy/dual_walk.hpp"
#include "narrow/backend.hpp"
#include "partition/partition.hpp"
#include "results/assemble.hpp"
#include "results/collector.hpp"
#include "schedule/cost.hpp"
#include "schedule/parallel.hpp"

namespace impinge {
namespace {

// A slice of work: long enough that clocks and hand-overs do not show, short enough that threads share one large pair.
constexpr std::size_t kLeafPairsPerSlice = 64;
constexpr std::uint64_t kBoxTestsPerSlice = 8192;
// A batch is closed when it has so many tests: it stays in cache, and memory stays bounded with large leaves.
constexpr std::size_t kTestsPerBatch = 16384;

/// Adds the time since it was last asked to a counter.
class StageClock {
 public:
  void charge(double& seconds) {
    const auto now = std::chrono::steady_clock::now();
    seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// What one thread keeps while it works on a query.
struct Worker {
  explicit Worker(const Options& options)
      : partitioner({.grid = options.grid}),
        backend(narrow::make_scalar_backend()),
        collector(options.kinds, options.limit) {}

  hierarchy::LeafPairs leaf_pairs;
  partition::Partitioner partitioner;
  partition::Batch batch;
  std::unique_ptr<narrow::Backend> backend;
  std::vector<narrow::Verdict> verdicts;
  std::vector<exact::Contact> contacts;
  results::Collector collector;
  Statistics statistics;
};

/// Part of the walk down the trees of one pair of objects.
struct Task {
  std::uint32_t object_pair;
  std::vector<hierarchy::NodePair> stack;  ///< empty: from the roots
};

/// What is known of one pair of objects while its tasks run.
struct PairState {
  std::atomic<std::uint32_t> open_tasks{1};
  std::atomic<bool> settled{false};  ///< `Find::first` has its witness
};

void add(Statistics& sum, const Statistics& s) {
  sum.box_tests += s.box_tests, sum.element_tests += s.element_tests, sum.nodes_built += s.nodes_built;
  sum.leaf_pairs += s.leaf_pairs, sum.triangle_pairs += s.triangle_pairs, sum.exact_calls += s.exact_calls;
  sum.hierarchy_seconds += s.hierarchy_seconds, sum.partition_seconds += s.partition_seconds;
  sum.narrow_seconds += s.narrow_seconds, sum.exact_seconds += s.exact_seconds;
}

class Pipeline {
 public:
  explicit Pipeline(const Query& query)
      : query_(query),
        options_(query.options),
        workers_([this] { return Worker(options_); }),
        first_only_(options_.find == Options::Find::first) {}

  Result<Contacts> run() {
    StageClock total, stage;
    pairs_ =
        query_.borders != nullptr ? query_.borders->find(query_.view, options_.stop) : broad::all_pairs(query_.view);
    states_ = std::make_unique<PairState[]>(pairs_.size());
    if (pairs_.size() > std::numeric_limits<std::uint32_t>::max())
      return Error{Code::out_of_memory, "more than 2^32 pairs of objects may touch; cut the scene into parts"};
    report_total();
    Statistics statistics;
    statistics.object_pairs = pairs_.size();
    stage.charge(statistics.broad_seconds);

    schedule::run_tasks(first_tasks(), options_.threads, [&](Task& task, const auto& spawn) { run_task(task, spawn); });
    if (options_.stop.stop_requested()) return Error{Code::cancelled, "the query was stopped before it was complete"};

    double threads_wall_clock = 0;
    stage.charge(threads_wall_clock);
    Contacts contacts = gather(statistics);
    stage.charge(statistics.results_seconds);
    statistics.measured_seconds = schedule::modelled_seconds(statistics);
    total.charge(statistics.total_seconds);
    if (options_.predict_cost) predict(statistics);
    contacts.statistics = statistics;
    return contacts;
  }

 private:
  /// One a pair of objects. A single pair has its first slice done here: small questions end before a thread would
  /// wake.
  std::vector<Task> first_tasks() {
    std::vector<Task> tasks(pairs_.size());
    for (std::size_t i = 0; i < tasks.size(); ++i) tasks[i].object_pair = static_cast<std::uint32_t>(i);
    if (tasks.size() == 1) {
      run_slice(make_walk(0), true, tasks[0], workers_.local());
      if (tasks[0].stack.empty()) {
        report_done();
        tasks.clear();
      }
    }
    return tasks;
  }

  /// Walks on until the task's stack is empty, a slice at a time; after each slice half of what is left goes to whoever
  /// is idle.
  template <class Spawn>
  void run_task(Task& task, const Spawn& spawn) {
    PairState& state = states_[task.object_pair];
    Worker& worker = workers_.local();
    const hierarchy::DualWalk walk = make_walk(task.object_pair);
    bool fresh = task.stack.empty();
    while ((fresh || !task.stack.empty()) && !options_.stop.stop_requested() && !state.settled) {
      run_slice(walk, fresh, task, worker);
      fresh = false;
      if (options_.threads != 1 && task.stack.size() > 1) {
        state.open_tasks.fetch_add(1);
        spawn(cut_off_half(task));
      }
    }
    if (state.open_tasks.fetch_sub(1) == 1) report_done();
  }

  /// The stages, in order, on part of one pair of objects.
  void run_slice(const hierarchy::DualWalk& walk, bool fresh, Task& task, Worker& w) {
    StageClock clock;
    hierarchy::WalkCounts counts;
    w.leaf_pairs.clear();
    if (fresh) walk.start(task.stack, counts);
    walk.advance(task.stack, w.leaf_pairs, kLeafPairsPerSlice, kBoxTestsPerSlice, counts);
    clock.charge(w.statistics.hierarchy_seconds);
    w.statistics.box_tests += counts.box_tests;
    w.statistics.nodes_built += counts.nodes_made;
    w.statistics.leaf_pairs += w.leaf_pairs.size();
    if (w.leaf_pairs.empty()) return;

    const partition::PlacedMeshes placed = placed_meshes(task.object_pair);
    for (auto leaves = w.leaf_pairs.begin(); leaves != w.leaf_pairs.end();) {
      w.batch.clear();
      w.partitioner.restart();
      for (; leaves != w.leaf_pairs.end() && w.batch.tests.size() < kTestsPerBatch; ++leaves)
        w.partitioner.append(*leaves, placed, w.batch);
      clock.charge(w.statistics.partition_seconds);
      w.statistics.element_tests += w.batch.tests.size();
      w.statistics.triangle_pairs += w.batch.pairs.size();

      w.backend->submit(w.batch);
      narrow::fold(w.batch, w.backend->wait(), w.verdicts);
      clock.charge(w.statistics.narrow_seconds);

      w.contacts.clear();
      w.statistics.exact_calls += exact::decide(w.batch, w.verdicts, w.contacts);
      clock.charge(w.statistics.exact_seconds);

      collect(task.object_pair, w);
    }
  }

  void collect(std::uint32_t object_pair, Worker& w) {
    if (!first_only_) return w.collector.add(w.contacts);
    for (const exact::Contact& contact : w.contacts) {
      if (!w.collector.wants(contact.kind)) continue;
      if (!states_[object_pair].settled.exchange(true)) w.collector.add({&contact, 1});
      return;
    }
  }

  Contacts gather(Statistics& statistics) {
    std::vector<exact::Contact> contacts;
    std::uint64_t seen = 0;
    for (const Worker& worker : workers_) {
      add(statistics, worker.statistics);
      seen += worker.collector.seen();
      contacts.insert(contacts.end(), worker.collector.kept().begin(), worker.collector.kept().end());
    }
    std::vector<std::uint64_t> keys;
    for (const scene::PlacedObject& object : query_.view.objects) keys.push_back(object.key);
    return results::assemble(std::move(contacts), pairs_, keys, {options_.limit, seen, !first_only_});
  }

  static void predict(Statistics& s) {
    const schedule::CostConstants constants = calibrated_constants();
    s.box_test_seconds = constants.box_test;
    s.element_test_seconds = constants.element_test;
    s.node_seconds = constants.node;
    s.leaf_pair_seconds = constants.leaf_pair;
    s.predicted_seconds = schedule::predict_seconds(s, constants);
  }

  [[nodiscard]] hierarchy::DualWalk make_walk(std::uint32_t object_pair) const {
    const broad::ObjectPair& pair = pairs_[object_pair];
    const auto placed_tree = [&](std::uint32_t i) {
      const scene::PlacedObject& object = query_.view.objects[i];
      return hierarchy::PlacedTree{*query_.trees[i], *object.mesh, object.pose};
    };
    return {placed_tree(pair.a), placed_tree(pair.b), pair, object_pair};
  }

  [[nodiscard]] partition::PlacedMeshes placed_meshes(std::uint32_t object_pair) const {
    const scene::PlacedObject &a = query_.view.objects[pairs_[object_pair].a],
                              &b = query_.view.objects[pairs_[object_pair].b];
    return {*a.mesh, a.pose, *b.mesh, b.pose};
  }

  /// The older half of the stack: the larger subtrees.
  static Task cut_off_half(Task& task) {
    const auto middle = task.stack.begin() + static_cast<std::ptrdiff_t>(task.stack.size() / 2);
    Task half{task.object_pair, {task.stack.begin(), middle}};
    task.stack.erase(task.stack.begin(), middle);
    return half;
  }

  void report_total() const {
    if (options_.progress != nullptr) options_.progress->done = 0, options_.progress->total = pairs_.size();
  }
  void report_done() const {
    if (options_.progress != nullptr) options_.progress->done.fetch_add(1, std::memory_order_relaxed);
  }

  const Query& query_;
  const Options& options_;
  broad::ObjectPairs pairs_;
  std::unique_ptr<PairState[]> states_;
  schedule::PerWorker<Worker> workers_;
  bool first_only_;
};

}  // namespace

Result<void> validate(const Options& options) {
  const auto bad = [](std::string message) { return Error{Code::bad_option, std::move(message)}; };
  if (options.threads < 0)
    return bad("threads is " + std::to_string(options.threads) + "; choose 0 for all, or a positive number");
  if (options.find != Options::Find::all && options.find != Options::Find::first)
    return bad("find is neither Find::all nor Find::first");
  if (options.kinds > kAllKinds) return bad("kinds has bits beyond kCrossing | kTouching | kCoplanar");
  if (options.backend != "auto" && options.backend != "scalar")
    return bad("there is no backend '" + std::string(options.backend) + "'; choose auto or scalar");
  return {};
}

Result<Contacts> run_pipeline(const Query& query) {
  for (std::size_t i = 0; i < query.view.objects.size(); ++i) {
    if (query.view.objects[i].in_domain) continue;
    return Error{Code::out_of_range,
                 "object " + std::to_string(i) +
                     " has world coordinates that are not below 2^300 or not multiples of 2^-358, where answers would "
                     "not be exact; scale the scene, or move it nearer to the origin"};
  }
  return Pipeline(query).run();
}

}  // namespace impinge
