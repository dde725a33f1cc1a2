// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/pipeline.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <thread>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "broad/may_touch.hpp"
#include "core/stopped.hpp"
#include "pipeline/calibration.hpp"
#include "pipeline/device_driver.hpp"
#include "pipeline/domain_error.hpp"
#include "pipeline/lone_pair.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/query_way.hpp"
#include "pipeline/self_pair.hpp"
#include "pipeline/stage_clock.hpp"
#include "pipeline/workspace_state.hpp"
#include "schedule/cost.hpp"
#include "schedule/parallel.hpp"

namespace impinge {
namespace {

void add(Statistics& sum, const Statistics& s) {
  sum.box_tests += s.box_tests, sum.element_tests += s.element_tests, sum.nodes_built += s.nodes_built;
  sum.triangles_sorted += s.triangles_sorted;
  sum.leaf_pairs += s.leaf_pairs, sum.triangle_pairs += s.triangle_pairs, sum.exact_calls += s.exact_calls;
  sum.hierarchy_seconds += s.hierarchy_seconds, sum.partition_seconds += s.partition_seconds;
  sum.narrow_seconds += s.narrow_seconds, sum.exact_seconds += s.exact_seconds;
  sum.images_drawn += s.images_drawn, sum.images_overlapped += s.images_overlapped, sum.images_read += s.images_read;
  sum.device_seconds += s.device_seconds, sum.device_predicted_seconds += s.device_predicted_seconds;
  sum.device_wait_seconds += s.device_wait_seconds;
}

// Where a device takes part: kManyPairs pairs of objects are enough pieces to share, and fewer are walked until there
// are kPieces, which walks of a millisecond come to; kEnoughForAMix tests of boxes show the proportions of
// a query's costs.
constexpr std::size_t kManyPairs = 256, kPieces = 256;
constexpr std::uint64_t kEnoughForAMix = 1 << 14;
constexpr int kSlicesForPieces = 8;

/// One query: the broad phase, then for each pair of objects the stages that `Stages` strings together, a slice of work
/// at a time, then the results.
template <class Stages>
class Pipeline {
 public:
  /// `has_begun`: with the query's only pair.
  Pipeline(const Query& query, Crew<Stages>& crew, Workspace::State& memory, bool has_begun = false)
      : query_(query),
        options_(query.options),
        crew_(crew),
        memory_(memory),
        has_begun_(has_begun),
        first_only_(options_.find == Options::Find::first) {
    crew_.is_timed = options_.statistics || options_.predict_cost || crew_.device != nullptr;
  }
  ~Pipeline() { crew_.release(); }
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  Result<Contacts> run() {
    StageClock total(crew_.is_timed || options_.backend == "auto"), stage(crew_.is_timed);
    Statistics& statistics = memory_.spare.statistics;
    if (!has_begun_) statistics = {};
    if (query_.pairs == nullptr)
      find_pairs(statistics);
    else if (query_.all_rows)
      statistics.sphere_tests = pairs().size();  // by is_apart
    if (pairs().size() > std::numeric_limits<std::uint32_t>::max())
      return Error{Code::out_of_memory, "more than 2^32 pairs of objects may touch; cut the scene into parts"};
    prepare_states();
    report_total();
    statistics.object_pairs = pairs().size();
    stage.charge(statistics.broad_seconds);

    memory_.found_beside_crew.restart(options_.kinds, options_.limit);
    if constexpr (std::is_same_v<Stages, FastStages>) {
      if (!has_begun_ && options_.backend == "auto" && DeviceDriver::may_help(query_, pairs()))
        memory_.asks_device = true, memory_.device = gpu::Devices::of_process().look_up(options_.device).opened;
      if (memory_.asks_device) {
        way_.choose(query_, pairs(), memory_);
        memory_.asks_device = way_.way() != schedule::Way::cpu;
      }
      if (memory_.asks_device) {
        work_with_device();
      } else if (has_begun_ || (pairs().size() == 1 && !is_apart(pairs()[0]))) {
        if (!std::exchange(has_begun_, true)) begin_lone_pair(query_, pairs()[0], crew_.is_timed, memory_);
        collect(memory_.found_beside_crew, 0, memory_.touch.contacts());
        if (settled(0)) memory_.touch.left().clear();
      }
    }
    if (has_begun_ && memory_.touch.left().empty()) {
      report_done();
    } else if (!memory_.asks_device) {
      work_on_all();
    }
    if (options_.stop.stop_requested()) return cancelled();

    if constexpr (std::is_same_v<Stages, PlainStages>)
      if (crew_.device != nullptr) finish_batches();

    double threads_wall_clock = 0;
    stage.charge(threads_wall_clock);
    gather(statistics);
    stage.charge(statistics.results_seconds);
    statistics.measured_seconds = schedule::modelled_seconds(cpu_statistics_);
    double total_seconds = 0;
    total.charge(total_seconds);
    if (crew_.is_timed || memory_.asks_device) statistics.total_seconds = total_seconds;
    way_.learn(statistics, has_brought_meshes_);
    if (options_.predict_cost) predict(statistics);
    if (options_.backend == "auto" && !memory_.asks_device) DeviceDriver::count_without_help(total_seconds);
    memory_.spare.partial = first_only_ || options_.kinds != kAllKinds;
    memory_.spare.warnings = std::move(memory_.warnings);
    return std::move(memory_.spare);
  }

 private:
  /// The work on some pairs of objects, or part of that on one.
  struct Task {
    std::uint32_t first_pair, count;
    std::vector<typename Stages::Step> stack;  ///< of what is left of the first one; empty: from the roots
  };

  [[nodiscard]] const broad::ObjectPairs& pairs() const {
    return query_.pairs == nullptr ? memory_.pairs : *query_.pairs;
  }

  /// The broad phase.
  void find_pairs(Statistics& statistics) {
    if constexpr (std::is_same_v<Stages, PlainStages>) {
      memory_.borders.update(query_.view);
      memory_.borders.find(query_.view, memory_.pairs, options_.stop);
      const paper::SweepAndPrune::Counts& counts = memory_.borders.counts();
      statistics.bounds_updated = counts.updated;
      statistics.border_moves = counts.moves;
      statistics.sphere_tests = counts.sphere_tests;
    } else {
      statistics.sphere_tests =
          query_.near_pairs->find(query_.view, memory_.pairs, memory_.near_pairs,
                                  {.stop = options_.stop, .for_each = on_threads(options_.threads)});
    }
    const auto found = static_cast<std::ptrdiff_t>(memory_.pairs.size());
    for (const broad::ObjectPair& own : query_.own_pairs)
      if (query_.view.objects[own.a].mesh != nullptr) memory_.pairs.push_back(own);
    std::inplace_merge(
        memory_.pairs.begin(), memory_.pairs.begin() + found, memory_.pairs.end(),
        [](const broad::ObjectPair& p, const broad::ObjectPair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
  }

  /// Where each pair has a row (`all_rows`), pairs whose bounds do not meet are not tested: their rows stay empty.
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

  void work_on_all() {
    if (options_.threads == 1) {
      Worker<Stages>& worker = crew_.take(options_);
      if constexpr (std::is_same_v<Stages, FastStages>)
        if (has_begun_) worker.stack.swap(memory_.touch.left());
      for (std::uint32_t i = 0; i < pairs().size(); ++i) run(i, worker, [](std::uint32_t, Worker<Stages>&) {});
      crew_.give_back(worker);
      return;
    }
    // Where pairs abound a task is several of them, since most are done in a microsecond or two, and taking up a task
    // is a turn at a lock; each thread gets some sixteen tasks, so that all end together.
    const auto number = static_cast<std::uint32_t>(pairs().size());
    const auto threads = static_cast<std::uint32_t>(schedule::concurrency(options_.threads));
    const std::uint32_t at_once = std::clamp<std::uint32_t>(number / 16 / threads, 1, 16);
    std::vector<Task> tasks;
    tasks.reserve(number / at_once + 1);
    for (std::uint32_t i = 0; i < number; i += at_once) tasks.push_back({i, std::min(at_once, number - i), {}});
    if constexpr (std::is_same_v<Stages, FastStages>)
      if (has_begun_) tasks[0].stack = std::move(memory_.touch.left());
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

  /// The device knows nothing of neighbours: of objects with themselves the CPU does all the work.
  [[nodiscard]] bool is_for_cpu(std::size_t object_pair) const {
    return pairs()[object_pair].a == pairs()[object_pair].b;
  }
  void work_on_own_pairs() {
    std::vector<Task> tasks;
    for (std::uint32_t i = 0; i < pairs().size(); ++i)
      if (is_for_cpu(i)) tasks.push_back({i, 1, {}});
    work_on(std::move(tasks));
  }

  /// All work goes to the device, and what it cannot take, or all of it if it fails, to the CPU; or the CPU begins, and
  /// where it has much left to do, it shares that with the device.
  void work_with_device() {
    const bool are_shared = way_.way() == schedule::Way::both, are_many = pairs().size() >= kManyPairs;
    const bool are_whole = are_many || !are_shared;
    std::vector<DevicePiece> pieces;
    std::vector<std::vector<DevicePiece>> opened(are_whole ? 0 : pairs().size());
    run_each(are_whole ? ForEach() : on_threads(options_.threads), pairs().size(), [&](std::size_t i) {
      const auto object_pair = static_cast<std::uint32_t>(i);
      if (is_apart(pairs()[i])) return report_done();
      if (is_for_cpu(i)) return;
      if (are_whole) return pieces.push_back({object_pair});  // on this thread alone
      Worker<Stages>& worker = crew_.take(options_);
      open_up(object_pair, worker, opened[i]);
      crew_.give_back(worker);
    });
    for (const auto& some : opened) pieces.insert(pieces.end(), some.begin(), some.end());
    // The costs of what has been done predict the rest; where nothing has been done yet, the last pairs are done first.
    if (are_shared && are_many) {
      Worker<Stages>& worker = crew_.take(options_);
      while (pieces.size() > kManyPairs / 2 && worker.statistics.box_tests < kEnoughForAMix) {
        run(pieces.back().object_pair, worker, [](std::uint32_t, Worker<Stages>&) {});
        pieces.pop_back();
      }
      crew_.give_back(worker);
    }
    Statistics mix;
    for (const Worker<Stages>* one : crew_.at_work()) add(mix, one->statistics);
    share_with_device(std::move(pieces), are_shared ? options_.device_share : 1, mix);
    work_on_own_pairs();
  }

  /// Walks on a pair of objects until there are pieces enough to share, or nothing is left.
  void open_up(std::uint32_t object_pair, Worker<Stages>& worker, std::vector<DevicePiece>& pieces) {
    const typename Stages::Pair pair(query_, pairs()[object_pair]);
    const std::size_t enough = std::max<std::size_t>(kPieces / pairs().size(), 1);
    int slices = 0;
    do {
      run_slice(pair, object_pair, slices == 0, worker);
    } while (++slices < kSlicesForPieces && !worker.stack.empty() && worker.stack.size() < enough &&
             !settled(object_pair) && !options_.stop.stop_requested());
    if (settled(object_pair)) worker.stack.clear();
    for (const hierarchy::TreeRefPair& nodes : worker.stack) pieces.push_back({object_pair, nodes});
    if (worker.stack.empty()) {
      report_done();
    } else {
      memory_.pair_states[object_pair].open_tasks = static_cast<std::uint32_t>(worker.stack.size());
    }
    worker.stack.clear();
  }

  /// The number of triangles below both nodes, which the work grows with. Pieces that are whole pairs of objects count
  /// alike.
  static double weight_of(const DevicePiece& piece) {
    const auto below = [](const hierarchy::TreeRef& ref) {
      if (ref.is_leaf()) return static_cast<double>(ref.leaf().count);
      return static_cast<double>(std::accumulate(ref.node().count, ref.node().count + ref.node().size, 0u));
    };
    return piece.nodes.a.is_made() ? below(piece.nodes.a) + below(piece.nodes.b) : 1;
  }

  void share_with_device(std::vector<DevicePiece> pieces, double share, const Statistics& mix) {
    if (pieces.empty()) return;
    std::vector<double> weights(pieces.size());
    std::transform(pieces.begin(), pieces.end(), weights.begin(), weight_of);
    SharedWork work(std::move(pieces), weights);
    DeviceDriver driver(query_, pairs(), work, memory_.device, mix);
    const auto sink = [&](std::uint32_t object_pair, std::span<const results::ContactKey> contacts) {
      collect(memory_.found_beside_crew, object_pair, contacts);
    };
    if (share >= 0) {
      driver.reserve(share, true);
    } else if (way_.first_share() > 0) {
      driver.reserve(way_.first_share(), false);
    }
    if (share == 1) {
      driver.drive(sink);
    } else {
      const std::jthread device([&] { driver.drive(sink); });
      StageClock clock;
      work_on_shared(work);
      clock.charge(cpu_seconds_);
    }
    finish(driver);
  }

  /// The CPU's side: each thread takes pieces from the back, fewer as the work runs out.
  void work_on_shared(SharedWork& work) {
    const int threads = schedule::concurrency(options_.threads);
    std::vector<Task> tasks(static_cast<std::size_t>(threads), Task{0, 0, {}});
    schedule::run_tasks(std::move(tasks), options_.threads, [&](Task& task, const auto& spawn) {
      Worker<Stages>& worker = crew_.take(options_);
      const auto share = [&](std::uint32_t object_pair, Worker<Stages>& w) {
        if (threads == 1 || w.stack.size() < 2) return;
        memory_.pair_states[object_pair].open_tasks.fetch_add(1);
        spawn(Task{object_pair, 1, cut_off_half(w.stack)});
      };
      if (task.count > 0) {  // a part of a piece
        worker.stack.assign(task.stack.begin(), task.stack.end());
        run(task.first_pair, worker, share);
      }
      while (task.count == 0) {
        const auto range = work.row.take_back(schedule::cpu_portion(work.row.left(), threads));
        if (range.empty()) break;
        for (std::size_t i = range.end; i-- > range.begin;) {
          if (work.pieces[i].nodes.a.is_made()) worker.stack.push_back(work.pieces[i].nodes);
          run(work.pieces[i].object_pair, worker, share);
        }
        work.cpu_done.fetch_add(range.weight);
      }
      crew_.give_back(worker);
    });
  }

  /// Takes over the device's results, or its work.
  void finish(const DeviceDriver& driver) {
    std::span<const DevicePiece> undone = driver.left();
    has_brought_meshes_ = driver.has_brought_meshes();
    if (!driver.complaint().empty()) {
      undone = driver.done();
      if (first_only_)
        for (const results::Run& run : memory_.found_beside_crew.runs())
          memory_.pair_states[run.object_pair].settled = false;
      memory_.found_beside_crew.restart(options_.kinds, options_.limit);
      memory_.warnings.push_back(driver.complaint() + "; the CPU did its work");
    } else {
      device_statistics_ = driver.statistics();
      if (options_.predict_cost) device_statistics_.device_predicted_seconds = driver.predict_seconds();
      if (!undone.empty())
        memory_.warnings.push_back(driver.device_name() +
                                   " could not take all pairs, for want of room or because they are too far from "
                                   "the origin for its precision; the CPU did the rest");
      for (const DevicePiece& piece : undone) memory_.pair_states[piece.object_pair].open_tasks.fetch_add(1);
      for (const DevicePiece& piece : driver.done()) close(piece.object_pair);
    }
    std::vector<Task> tasks;
    for (const DevicePiece& piece : undone) {
      tasks.push_back({piece.object_pair, 1, {}});
      if (piece.nodes.a.is_made()) tasks.back().stack.push_back(piece.nodes);
    }
    work_on(std::move(tasks));
  }

  /// Warns, once a query, that the device of the plain stages failed.
  void warn(const std::string& complaint) {
    if (complaint.empty() || !memory_.warnings.empty()) return;
    memory_.warnings.push_back(std::string("the device '") + crew_.device->device.physical().properties.deviceName +
                               "' failed (" + complaint + "); the CPU did its work");
  }

  /// Walks on until the worker's stack is empty, a slice at a time; after each slice the rest is offered for sharing.
  template <class Share>
  void run(std::uint32_t object_pair, Worker<Stages>& worker, const Share& share) {
    if (!is_apart(pairs()[object_pair])) {
      const typename Stages::Pair pair(query_, pairs()[object_pair]);
      bool fresh = worker.stack.empty();
      if (!fresh) worker.stages.resume();
      while ((fresh || !worker.stack.empty()) && !options_.stop.stop_requested() && !settled(object_pair)) {
        run_slice(pair, object_pair, fresh, worker);
        fresh = false;
        if (worker.stages.is_worth_sharing()) share(object_pair, worker);
      }
      worker.stack.clear();
    }
    close(object_pair);
  }

  /// One of a pair's tasks is done.
  void close(std::uint32_t object_pair) {
    if (memory_.pair_states[object_pair].open_tasks.fetch_sub(1) == 1) report_done();
  }

  void run_slice(const typename Stages::Pair& pair, std::uint32_t object_pair, bool fresh, Worker<Stages>& w) {
    if constexpr (std::is_same_v<Stages, PlainStages>) {
      w.stages.run_slice(pair, object_pair, fresh, w.stack, w.clock, w.statistics);
      collect_finished(w);
    } else {
      w.stages.run_slice(pair, fresh, w.stack, w.clock, w.statistics);
      collect(w.collector, object_pair, w.stages.contacts());
    }
  }

  /// The last batches of the plain stages, which the device still has.
  void finish_batches() {
    run_each(on_threads(options_.threads), crew_.at_work().size(), [&](std::size_t i) {
      Worker<Stages>& worker = *crew_.at_work()[i];
      worker.clock = StageClock(crew_.is_timed);
      worker.stages.finish(worker.clock, worker.statistics);
      collect_finished(worker);
    });
  }

  /// Of the plain stages, whose batches may end after their pair's slice.
  void collect_finished(Worker<Stages>& w) {
    std::span<const results::ContactKey> contacts = w.stages.contacts();
    for (const results::Run& run : w.stages.runs()) {
      const auto of_run = contacts.first(run.count);
      if (const auto [a, b] = pairs()[run.object_pair]; a == b) {
        collect(w.collector, run.object_pair, self_contacts(query_.view.objects[a], of_run));
      } else {
        collect(w.collector, run.object_pair, of_run);
      }
      contacts = contacts.subspan(run.count);
    }
  }

  /// Of an object's contacts with itself those that count, once each.
  [[nodiscard]] std::vector<results::ContactKey> self_contacts(const scene::PlacedObject& object,
                                                               std::span<const results::ContactKey> contacts) const {
    std::vector<results::ContactKey> kept;
    for (const results::ContactKey contact : contacts) {
      const TrianglePair pair{results::triangle_a(contact), results::triangle_b(contact)};
      if (pair.a >= pair.b) continue;
      const SelfPair self(object, pair, options_.adjacency);
      if (!self.are_neighbours() || self.meet_beyond()) kept.push_back(contact);
    }
    return kept;
  }

  void collect(results::Collector& to, std::uint32_t object_pair, std::span<const results::ContactKey> contacts) {
    if (!first_only_) return to.add(object_pair, contacts);
    for (const results::ContactKey& contact : contacts) {
      if (!to.wants(results::kind_of(contact))) continue;
      if (!memory_.pair_states[object_pair].settled.exchange(true)) to.add(object_pair, {&contact, 1});
      return;
    }
  }

  [[nodiscard]] bool settled(std::uint32_t object_pair) const {
    return memory_.pair_states[object_pair].settled.load(std::memory_order_relaxed);
  }

  /// Puts the answer together.
  void gather(Statistics& statistics) {
    memory_.collectors.clear();
    for (const Worker<Stages>* worker : crew_.at_work()) {
      if constexpr (std::is_same_v<Stages, PlainStages>) warn(worker->stages.complaint());
      add(statistics, worker->statistics);
      memory_.collectors.push_back(&worker->collector);
    }
    cpu_statistics_ = statistics;
    if (memory_.asks_device) {
      add(statistics, device_statistics_);
      statistics.cpu_seconds = cpu_seconds_;
    }
    memory_.collectors.push_back(&memory_.found_beside_crew);
    const auto key_of = [&](std::uint32_t object) {
      return scene::key(query_.meshes[object]->data, query_.view.objects[object].pose);
    };
    results::assemble(memory_.collectors, pairs(), key_of,
                      {options_.limit, !first_only_, query_.all_rows, on_threads(options_.threads)}, memory_.assembly,
                      memory_.spare);
  }

  void predict(Statistics& s) const {
    const schedule::CostConstants constants = calibrated_constants(options_.backend);
    for (const schedule::CostTerm& term : schedule::kCostTerms) s.*term.seconds = constants.*term.constant;
    s.predicted_seconds = schedule::predict_seconds(cpu_statistics_, constants);
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
  bool has_begun_;  ///< what is left of the only pair, and what was found, is in `memory_.touch`
  bool first_only_;
  Statistics cpu_statistics_, device_statistics_;  ///< of either's part
  double cpu_seconds_ = 0;                         ///< the CPU's, beside the device
  QueryWay way_;                                   ///< where a device may take part
  bool has_brought_meshes_ = false;
};

}  // namespace

Result<Contacts> run_pipeline(const Query& query, Workspace::State& memory) {
  for (std::size_t i = 0; i < query.view.objects.size(); ++i) {
    if (query.view.objects[i].in_domain) continue;
    return not_in_range("object " + std::to_string(i));
  }
  const bool has_begun = may_end_at_once(query);
  if (has_begun) {
    const bool is_answer = answer_at_once(query, memory);
    if (query.options.stop.stop_requested()) return cancelled();
    if (is_answer) return std::move(memory.spare);
  }
  memory.warnings.clear(), memory.asks_device = false;
  memory.plain.device = nullptr;
  if (query.options.backend == "paper" || query.options.backend == "scalar")
    return Pipeline<PlainStages>(query, memory.plain, memory).run();
  if (query.options.backend == "gpu" || query.options.backend == "raster" || query.options.backend == "hybrid") {
    // A hybrid query opens a device only when that is worth it.
    gpu::Devices& devices = gpu::Devices::of_process();
    const bool is_sure = query.options.backend != "hybrid" || query.options.device_share >= 0;
    gpu::Devices::Choice choice =
        is_sure ? devices.choose(query.options.device) : devices.look_up(query.options.device);
    if (choice.is_unknown) return Error{Code::no_device, choice.complaint};
    if (!choice.complaint.empty()) memory.warnings.push_back("the CPU does all the work: " + choice.complaint);
    // A hybrid query leaves out a program that would take its time from the CPU's threads.
    memory.asks_device =
        choice.complaint.empty() && query.options.backend != "raster" && (is_sure || !choice.is_software);
    memory.device = std::move(choice.opened);
  }
  if (query.options.backend == "raster") {
    memory.plain.device = std::move(memory.device);
    Result<Contacts> contacts = Pipeline<PlainStages>(query, memory.plain, memory).run();
    memory.plain.device = nullptr;
    return contacts;
  }
  Result<Contacts> contacts = Pipeline<FastStages>(query, memory.fast, memory, has_begun).run();
  memory.device = nullptr;
  return contacts;
}

}  // namespace impinge
