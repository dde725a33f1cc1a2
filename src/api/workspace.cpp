// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/workspace.hpp"

#include <algorithm>
#include <utility>

#include "pipeline/workspace_state.hpp"

namespace impinge {
namespace {

/// A thread's own memory is kept from query to query if it has not grown beyond this; how long queries took, always.
constexpr std::size_t kMostContactsKept = 1 << 16, kMostPairsKept = 1 << 16;

struct ThreadMemory {
  Workspace workspace;
  bool is_taken = false;  ///< a thread that waits for others may take up another query meanwhile
};

ThreadMemory& thread_memory() {
  thread_local ThreadMemory memory;
  return memory;
}

}  // namespace

template <class Stages>
Worker<Stages>& Crew<Stages>::take(const Options& options) {
  const std::lock_guard lock(mutex_);
  if (!idle_.empty()) {
    Worker<Stages>& worker = *idle_.back();
    idle_.pop_back();
    worker.clock = StageClock(is_timed);
    return worker;
  }
  const std::size_t next = at_work_.size();
  if (next == all_.size()) {
    all_.push_back(std::make_unique<Worker<Stages>>());
    at_work_.reserve(all_.capacity()), idle_.reserve(all_.capacity());
  }
  Worker<Stages>& worker = *all_[next];
  if constexpr (std::is_same_v<Stages, PlainStages>) {
    worker.stages.configure(options, device.get());
  } else {
    worker.stages.configure(options.find, options.kinds);
  }
  worker.stack.clear();
  worker.collector.restart(options.kinds, options.limit);
  worker.statistics = {};
  worker.clock = StageClock(is_timed);
  at_work_.push_back(&worker);
  return worker;
}

template <class Stages>
void Crew<Stages>::give_back(Worker<Stages>& worker) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(&worker);
}

template <class Stages>
void Crew<Stages>::release() {
  if constexpr (std::is_same_v<Stages, PlainStages>)
    for (Worker<Stages>* worker : at_work_) worker->stages.release();
  idle_.clear(), at_work_.clear();
}

template class Crew<PlainStages>;
template class Crew<FastStages>;

Workspace::Workspace() : state_(std::make_unique<State>()) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

void Workspace::recycle(Contacts&& contacts) { state_->spare = std::move(contacts); }

QueryMemory::QueryMemory(Workspace* workspace) {
  if (workspace == nullptr && !thread_memory().is_taken) {
    is_threads_own_ = thread_memory().is_taken = true;
    workspace = &thread_memory().workspace;
  } else if (workspace == nullptr) {
    extra_ = std::make_unique<Workspace>();
    workspace = extra_.get();
  }
  state_ = &workspace->state();
}

QueryMemory::~QueryMemory() {
  if (!is_threads_own_) return;
  thread_memory().is_taken = false;
  if (state_->assembly.keys.capacity() > kMostContactsKept ||
      (has_distances_ && state_->nearest.pairs_kept() > kMostPairsKept)) {
    Workspace smaller;
    smaller.state().ways = std::move(state_->ways);
    thread_memory().workspace = std::move(smaller);
  }
}

}  // namespace impinge
