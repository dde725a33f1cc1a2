// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "broad/near_pairs.hpp"
#include "broad/object_pairs.hpp"
#include "impinge/workspace.hpp"
#include "measure/pair_queue.hpp"
#include "paper/sweep_and_prune.hpp"
#include "pipeline/fast_stages.hpp"
#include "pipeline/plain_stages.hpp"
#include "pipeline/ready_device.hpp"
#include "pipeline/stage_clock.hpp"
#include "pipeline/touch_search.hpp"
#include "results/assemble.hpp"
#include "results/collector.hpp"
#include "schedule/ways.hpp"

namespace impinge {

/// What one thread keeps while it works on a query.
template <class Stages>
struct Worker {
  Stages stages;
  std::vector<typename Stages::Step> stack;
  results::Collector collector;
  Statistics statistics;
  StageClock clock;  ///< since it took up its task: stages follow each other
};

/// As many workers as threads have been at work at once.
template <class Stages>
class Crew {
 public:
  Worker<Stages>& take(const Options& options);
  void give_back(Worker<Stages>& worker);
  /// Those that worked since the last `release`.
  [[nodiscard]] const std::vector<Worker<Stages>*>& at_work() const { return at_work_; }
  void release();

  std::shared_ptr<gpu::ReadyDevice> device;  ///< for the plain stages of the query at hand; null: none
  bool is_timed = false;                     ///< whether workers' clocks run in the query at hand

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Worker<Stages>>> all_;
  std::vector<Worker<Stages>*> idle_;     ///< taken and given back in this query
  std::vector<Worker<Stages>*> at_work_;  ///< configured for this query
};

/// What is known of one pair of objects while its tasks run.
struct PairState {
  std::atomic<std::uint32_t> open_tasks{1};
  std::atomic<bool> settled{false};  ///< `Find::first` has its witness
};

struct Workspace::State {
  Crew<PlainStages> plain;
  Crew<FastStages> fast;
  std::vector<scene::PlacedObject> placed;
  std::vector<const MeshState*> meshes;
  broad::ObjectPairs pairs;
  paper::SweepAndPrune borders;  ///< of the last query by the paper's way
  broad::NearPairs::Scratch near_pairs;
  std::unique_ptr<PairState[]> pair_states;
  std::size_t pair_states_size = 0;
  std::vector<const results::Collector*> collectors;
  results::AssembleScratch assembly;
  Contacts spare;
  measure::PairMemory nearest;
  TouchSearch touch;                                       ///< of the thread that asks; it begins with a lone pair
  bool asks_device = false;                                ///< in the query at hand
  std::shared_ptr<gpu::ReadyDevice> device;                ///< then; null: not opened yet
  results::Collector found_beside_crew;                    ///< by a device, or by the thread that asks when it began
  std::unordered_map<std::uint64_t, schedule::Ways> ways;  ///< of hybrid queries, by kind
  std::vector<std::string> warnings;
};

/// Memory for a query: that of the caller's workspace, or the calling thread's own.
class QueryMemory {
 public:
  explicit QueryMemory(Workspace* workspace);
  ~QueryMemory();
  QueryMemory(const QueryMemory&) = delete;
  QueryMemory& operator=(const QueryMemory&) = delete;
  Workspace::State& operator*() const { return *state_; }
  Workspace::State* operator->() const { return state_; }
  /// For distances: looked at for its size when this query ends.
  measure::PairMemory& nearest() {
    has_distances_ = true;
    return state_->nearest;
  }

 private:
  Workspace::State* state_;
  bool is_threads_own_ = false, has_distances_ = false;
  std::unique_ptr<Workspace> extra_;
};

}  // namespace impinge
