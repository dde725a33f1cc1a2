// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/float_environment.hpp"

namespace impinge::schedule {

/// One T a thread, made when the thread first asks.
template <class T>
using PerWorker = tbb::enumerable_thread_specific<T>;

/// Shows the thread sanitizer that what one thread wrote before it handed work to TBB comes before what another does
/// with it: TBB orders them itself, but Debian's is not instrumented. `give` follows the last write, `take` precedes
/// the first read. Nothing in other builds.
class HandOver {
 public:
#if defined(__SANITIZE_THREAD__)
  void give() { count_.fetch_add(1, std::memory_order_release); }
  void take() { static_cast<void>(count_.load(std::memory_order_acquire)); }

 private:
  std::atomic<unsigned> count_{0};
#else
  void give() {}
  void take() {}
#endif
};

/// Up to so many threads of TBB's. Arenas are kept, one a size: oneTBB 2021.8 loses some kilobytes with each one that
/// ends.
tbb::task_arena& arena_of(int threads);

/// Runs `body(task, spawn)` for each task on up to `threads` threads (0: all there are). A body may call `spawn(task)`
/// to hand part of its work to whoever is idle. Tasks run in any order; with one thread they run on the caller's, those
/// spawned last first.
template <class Task, class Body>
void run_tasks(std::vector<Task> tasks, int threads, const Body& body) {
  if (threads == 1) {
    for (Task& first : tasks) {
      std::vector<Task> open;
      open.push_back(std::move(first));
      while (!open.empty()) {
        Task task = std::move(open.back());
        open.pop_back();
        body(task, [&](Task spawned) { open.push_back(std::move(spawned)); });
      }
    }
    return;
  }
  if (tasks.empty()) return;
  HandOver hand_over;
  std::vector<std::unique_ptr<Task>> firsts;
  for (Task& task : tasks) firsts.push_back(std::make_unique<Task>(std::move(task)));
  const auto run_all = [&] {
    tbb::parallel_for_each(firsts.begin(), firsts.end(), [&](std::unique_ptr<Task>& task, auto& feeder) {
      hand_over.take();
      const FloatEnvironment nearest;  // each worker has its own
      body(*task, [&](Task spawned) {
        auto handed = std::make_unique<Task>(std::move(spawned));
        hand_over.give();
        feeder.add(std::move(handed));
      });
      hand_over.give();
    });
  };
  hand_over.give();
  if (threads == 0) {
    run_all();
  } else {
    arena_of(threads).execute(run_all);
  }
  hand_over.take();
}

}  // namespace impinge::schedule
