// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "broad/may_touch.hpp"
#include "calibration.hpp"
#include "device_part.hpp"
#include "on_threads.hpp"
#include "schedule/cost.hpp"
#include "schedule/parallel.hpp"
#include "stage_clock.hpp"
#include "workspace_state.hpp"

namespace impinge {
namespace {

void add(Statistics& sum, const Statistics& s) {
  sum.box_tests += s.box_tests, sum.element_tests += s.element_tests, sum.nodes_built += s.nodes_built;
  sum.leaf_pairs += s.leaf_pairs, sum.triangle_pairs += s.triangle_pairs, sum.exact_calls += s.exact_calls;
  sum.hierarchy_seconds += s.hierarchy_seconds, sum.partition_seconds += s.partition_seconds;
  sum.narrow_seconds += s.narrow_seconds, sum.exact_seconds += s.exact_seconds;
}

/// One query: the broad phase, then for each pair of objects the stages that `Stages` strings together, a slice of work
/// at a time, then the results.
template <class Stages>
class Pipeline {
 public:
  Pipeline(const Query& query, Crew<Stages>& crew, Workspace::State& memory)
      : query_(query),
        options_(query.options),
        crew_(crew),
        memory_(memory),
        first_only_(options_.find == Options::Find::first) {}
  ~Pipeline() { crew_.release(); }
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  Result<Contacts> run() {
    StageClock total, stage = total;
    if (query_.near_pairs != nullptr)
      query_.near_pairs->find(query_.view, memory_.pairs, memory_.candidates,
                              {.stop = options_.stop, .for_each = on_threads(options_.threads)});
    if (pairs().size() > std::numeric_limits<std::uint32_t>::max())
      return Error{Code::out_of_memory, "more than 2^32 pairs of objects may touch; cut the scene into parts"};
    prepare_states();
    report_total();
    Statistics statistics;
    statistics.object_pairs = pairs().size();
    stage.charge(statistics.broad_seconds);

    if constexpr (std::is_same_v<Stages, FastStages>) {
      if (memory_.device != nullptr) work_on_device();
    }
    if (memory_.device == nullptr && (options_.threads == 1 || !work_on_first())) work_on_all();
    if (options_.stop.stop_requested()) return Error{Code::cancelled, "the query was stopped before it was complete"};

    double threads_wall_clock = 0;
    stage.charge(threads_wall_clock);
    Contacts contacts = gather(statistics);
    stage.charge(statistics.results_seconds);
    statistics.measured_seconds = schedule::modelled_seconds(statistics);
    total.charge(statistics.total_seconds);
    if (options_.predict_cost) predict(statistics);
    contacts.statistics = statistics;
    contacts.warnings = std::move(memory_.warnings);
    return contacts;
  }

 private:
  /// The work on some pairs of objects, or part of that on one.
  struct Task {
    std::uint32_t first_pair, count;
    std::vector<typename Stages::Step> stack;  ///< of what is left of the first one; empty: from the roots
  };

  [[nodiscard]] const broad::ObjectPairs& pairs() const {
    return query_.near_pairs != nullptr ? memory_.pairs : *query_.pairs;
  }

  /// Where each pair asked about has a row, some have nothing in it.
  [[nodiscard]] bool is_apart(const broad::ObjectPair& pair) const {
    return query_.all_rows && !broad::may_touch(query_.view, pair.a, pair.b);
  }

  void prepare_states() {
    if (memory_.pair_states_size < pairs().size()) {
      memory_.pair_states_size = 0;
      memory_.pair_states = std::make_unique<PairState[]>(pairs().size());
      memory_.pair_states_size = pairs().size();
    }
    for (std::size_t i = 0; i < pairs().size(); ++i) {
      memory_.pair_states[i].open_tasks.store(1, std::memory_order_relaxed);
      memory_.pair_states[i].settled.store(false, std::memory_order_relaxed);
    }
  }

  /// A lone pair has its first slice done by the caller's thread: small questions end before another would wake. False
  /// if work remains.
  bool work_on_first() {
    if (pairs().size() != 1 || is_apart(pairs()[0])) return false;
    Worker<Stages>& worker = crew_.take(options_);
    run_slice(typename Stages::Pair(query_, pairs()[0]), 0, true, worker);
    const bool done = worker.stack.empty() || settled(0);
    if (done) report_done();
    if (!done) first_stack_ = std::exchange(worker.stack, {});
    worker.stack.clear();
    crew_.give_back(worker);
    return done;
  }

  void work_on_all() {
    if (options_.threads == 1) {
      Worker<Stages>& worker = crew_.take(options_);
      for (std::uint32_t i = 0; i < pairs().size(); ++i) run(i, worker, [](std::uint32_t, Worker<Stages>&) {});
      crew_.give_back(worker);
      return;
    }
    // Where pairs abound a task is several of them: most are done in a microsecond or two.
    const auto number = static_cast<std::uint32_t>(pairs().size());
    const std::uint32_t at_once = std::clamp<std::uint32_t>(number / 1024, 1, 16);
    std::vector<Task> tasks;
    tasks.reserve(number / at_once + 1);
    for (std::uint32_t i = 0; i < number; i += at_once) tasks.push_back({i, std::min(at_once, number - i), {}});
    if (!first_stack_.empty()) tasks[0].stack = std::move(first_stack_);
    work_on(std::move(tasks));
  }

  void work_on(std::vector<Task> tasks) {
    schedule::run_tasks(std::move(tasks), options_.threads, [&](Task& task, const auto& spawn) {
      Worker<Stages>& worker = crew_.take(options_);
      worker.stack.assign(task.stack.begin(), task.stack.end());
      for (std::uint32_t i = 0; i < task.count; ++i) {
        run(task.first_pair + i, worker, [&](std::uint32_t object_pair, Worker<Stages>& w) {
          if (w.stack.size() < 2) return;
          memory_.pair_states[object_pair].open_tasks.fetch_add(1);
          spawn(Task{object_pair, 1, cut_off_half(w.stack)});
        });
      }
      crew_.give_back(worker);
    });
  }

  /// All on the device, and what it cannot take, or all if it fails, on the CPU.
  void work_on_device() {
    std::vector<DevicePiece> pieces;
    for (std::uint32_t i = 0; i < pairs().size(); ++i) {
      if (is_apart(pairs()[i])) {
        report_done();
      } else {
        pieces.push_back({i});
      }
    }
    std::vector<Task> tasks;
    for (const DevicePiece& piece : on_device(pieces)) tasks.push_back({piece.object_pair, 1, {}});
    work_on(std::move(tasks));
  }

  /// Returns what is left to the CPU.
  std::vector<DevicePiece> on_device(const std::vector<DevicePiece>& pieces) {
    Worker<FastStages>& worker = crew_.take(options_);
    std::vector<DevicePiece> left;
    try {
      DevicePart part(query_, pairs(), memory_.device);
      left = part.run(
          pieces, [&](std::uint32_t object_pair, auto contacts) { collect(worker, object_pair, contacts); },
          worker.statistics);
      if (!left.empty())
        memory_.warnings.push_back(device_name() + " had no room for all meshes; the CPU did the rest");
    } catch (const gpu::Failure& failure) {
      worker.collector.restart(options_.kinds, options_.limit);
      worker.statistics = {};
      for (std::size_t i = 0; i < pairs().size(); ++i)
        memory_.pair_states[i].settled.store(false, std::memory_order_relaxed);
      left = pieces;
      memory_.warnings.push_back(device_name() + " failed (" + failure.what() + "); the CPU did its work");
    }
    crew_.give_back(worker);
    return left;
  }

  /// Of a device that the plain stages had, once a query.
  void warn(const std::string& complaint) {
    if (complaint.empty() || !memory_.warnings.empty()) return;
    memory_.warnings.push_back(std::string("the device '") + crew_.device->device.physical().properties.deviceName +
                               "' failed (" + complaint + "); the CPU did its work");
  }

  [[nodiscard]] std::string device_name() const {
    return std::string("the device '") + memory_.device->device.physical().properties.deviceName + "'";
  }

  /// Walks on until the worker's stack is empty, a slice at a time; after each slice the rest is offered for sharing.
  template <class Share>
  void run(std::uint32_t object_pair, Worker<Stages>& worker, const Share& share) {
    if (!is_apart(pairs()[object_pair])) {
      const typename Stages::Pair pair(query_, pairs()[object_pair]);
      bool fresh = worker.stack.empty();
      while ((fresh || !worker.stack.empty()) && !options_.stop.stop_requested() && !settled(object_pair)) {
        run_slice(pair, object_pair, fresh, worker);
        fresh = false;
        share(object_pair, worker);
      }
      worker.stack.clear();
    }
    if (memory_.pair_states[object_pair].open_tasks.fetch_sub(1) == 1) report_done();
  }

  void run_slice(const typename Stages::Pair& pair, std::uint32_t object_pair, bool fresh, Worker<Stages>& w) {
    w.stages.run_slice(pair, fresh, w.stack, w.clock, w.statistics);
    collect(w, object_pair, w.stages.contacts());
  }

  void collect(Worker<Stages>& w, std::uint32_t object_pair, std::span<const results::ContactKey> contacts) {
    if (!first_only_) return w.collector.add(object_pair, contacts);
    for (const results::ContactKey& contact : contacts) {
      if (!w.collector.wants(results::kind_of(contact))) continue;
      if (!memory_.pair_states[object_pair].settled.exchange(true)) w.collector.add(object_pair, {&contact, 1});
      return;
    }
  }

  [[nodiscard]] bool settled(std::uint32_t object_pair) const {
    return memory_.pair_states[object_pair].settled.load(std::memory_order_relaxed);
  }

  Contacts gather(Statistics& statistics) {
    memory_.collectors.clear(), memory_.keys.clear();
    for (const Worker<Stages>* worker : crew_.at_work()) {
      if constexpr (std::is_same_v<Stages, PlainStages>) warn(worker->stages.complaint());
      add(statistics, worker->statistics);
      memory_.collectors.push_back(&worker->collector);
    }
    for (const scene::PlacedObject& object : query_.view.objects) memory_.keys.push_back(object.key);
    Contacts contacts = std::move(memory_.spare);  // a new one in its place would allocate
    results::assemble(memory_.collectors, pairs(), memory_.keys,
                      {options_.limit, !first_only_, query_.all_rows, on_threads(options_.threads)}, memory_.assembly,
                      contacts);
    return contacts;
  }

  void predict(Statistics& s) const {
    const schedule::CostConstants constants = calibrated_constants(options_.backend);
    s.box_test_seconds = constants.box_test;
    s.element_test_seconds = constants.element_test;
    s.node_seconds = constants.node;
    s.leaf_pair_seconds = constants.leaf_pair;
    s.exact_call_seconds = constants.exact_call;
    s.predicted_seconds = schedule::predict_seconds(s, constants);
  }

  /// The older half of the stack: the larger subtrees.
  static std::vector<typename Stages::Step> cut_off_half(std::vector<typename Stages::Step>& stack) {
    const auto middle = stack.begin() + static_cast<std::ptrdiff_t>(stack.size() / 2);
    std::vector<typename Stages::Step> half(stack.begin(), middle);
    stack.erase(stack.begin(), middle);
    return half;
  }

  void report_total() const {
    if (options_.progress != nullptr) options_.progress->done = 0, options_.progress->total = pairs().size();
  }
  void report_done() const {
    if (options_.progress != nullptr) options_.progress->done.fetch_add(1, std::memory_order_relaxed);
  }

  const Query& query_;
  const Options& options_;
  Crew<Stages>& crew_;
  Workspace::State& memory_;
  std::vector<typename Stages::Step> first_stack_;
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
  if (options.partition > Partition::all) return bad("partition is none of automatic, grid, sweep and all");
  constexpr std::string_view kBackends[] = {"auto", "simd", "scalar", "gpu", "raster", "hybrid"};
  if (std::find(std::begin(kBackends), std::end(kBackends), options.backend) == std::end(kBackends))
    return bad("there is no backend '" + std::string(options.backend) +
               "'; choose auto, simd, scalar, gpu, raster or hybrid");
  if (!(options.device_share <= 1)) return bad("device_share is not a number up to 1");
  return {};
}

Result<Contacts> run_pipeline(const Query& query, Workspace::State& memory) {
  for (std::size_t i = 0; i < query.view.objects.size(); ++i) {
    if (query.view.objects[i].in_domain) continue;
    return Error{Code::out_of_range,
                 "object " + std::to_string(i) +
                     " has world coordinates that are not below 2^300 or not multiples of 2^-358, where answers would "
                     "not be exact; scale the scene, or move it nearer to the origin"};
  }
  memory.warnings.clear(), memory.device = nullptr;
  memory.plain.device = nullptr;
  if (query.options.backend == "scalar") return Pipeline<PlainStages>(query, memory.plain, memory).run();
  if (query.options.backend == "gpu" || query.options.backend == "raster" || query.options.backend == "hybrid") {
    gpu::Devices::Choice choice = gpu::Devices::of_process().choose(query.options.device);
    if (choice.is_unknown) return Error{Code::no_device, choice.complaint};
    if (!choice.opened) memory.warnings.push_back("the CPU does all the work: " + choice.complaint);
    (query.options.backend == "raster" ? memory.plain.device : memory.device) = std::move(choice.opened);
  }
  if (query.options.backend == "raster") {
    Result<Contacts> contacts = Pipeline<PlainStages>(query, memory.plain, memory).run();
    memory.plain.device = nullptr;
    return contacts;
  }
  Result<Contacts> contacts = Pipeline<FastStages>(query, memory.fast, memory).run();
  memory.device = nullptr;
  return contacts;
}

}  // namespace impinge
