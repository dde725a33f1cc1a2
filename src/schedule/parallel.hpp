// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/float_environment.hpp"

namespace impinge::schedule {

/// Shows the thread sanitizer that what one thread wrote before it handed work to TBB comes before what another does
/// with it: TBB orders them itself, but Debian's is not instrumented. `give` follows the last write, `take` precedes
/// the first read, that of a closure's captures among them; by way of exceptions too. Nothing in other builds.
class HandOver {
 public:
#if defined(__SANITIZE_THREAD__)
  static void give() { count_.fetch_add(1, std::memory_order_release); }
  static void take() { static_cast<void>(count_.load(std::memory_order_acquire)); }

 private:
  static inline std::atomic<unsigned> count_{0};

 public:
#else
  static void give() {}
  static void take() {}
#endif

  /// Held while a piece of work runs that was handed over.
  struct Turn {
    Turn() { take(); }
    ~Turn() { give(); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
  };
  /// Held while other threads work.
  struct Wait {
    Wait() { give(); }
    ~Wait() { take(); }
    Wait(const Wait&) = delete;
    Wait& operator=(const Wait&) = delete;
  };
};

/// The TBB arena of up to so many threads. Arenas are kept, one for each size: oneTBB 2021.8 leaks some kilobytes with
/// each one that ends.
tbb::task_arena& arena_of(int threads);

/// The number of threads that an option stands for: 0 is all there are, and so is more than that.
int concurrency(int threads);

/// Runs body(0) to body(n - 1) on the caller's and other threads of its arena, up to `threads` in all (0: all there
/// are). Meanwhile the caller's thread does nothing else (in TBB's words, is isolated): it may hold what other tasks
/// wait for.
template <class Body>
void for_each(std::size_t n, int threads, const Body& body) {
  std::atomic<std::size_t> next{0};
  const auto take_turns = [&](std::size_t) {
    const HandOver::Turn turn;
    const FloatEnvironment nearest;
    for (std::size_t i = next++; i < n; i = next++) body(i);
  };
  const int most = threads == 0 ? tbb::this_task_arena::max_concurrency() : threads;
  const HandOver::Wait wait;
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, std::min(n, static_cast<std::size_t>(most)), take_turns,
                      tbb::simple_partitioner());
  });
}

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
  const auto run_all = [&] {
    HandOver::take();  // a full arena has one of its own threads run this
    tbb::task_group group;
    const auto run = [&](const auto& self, Task& task) -> void {
      const FloatEnvironment nearest;  // each worker has its own
      body(task, [&](Task spawned) {
        tbb::task_handle handle = group.defer([&self, kept = std::make_unique<Task>(std::move(spawned))] {
          const HandOver::Turn turn;
          self(self, *kept);
        });
        HandOver::give();
        group.run(std::move(handle));
      });
    };
    const auto run_one = [&](std::size_t i) {
      const HandOver::Turn turn;
      run(run, tasks[i]);
    };
    const auto run_firsts = [&] {
      HandOver::take();
      tbb::parallel_for(std::size_t{0}, tasks.size(), run_one);
    };
    tbb::task_handle handle = group.defer(run_firsts);
    HandOver::give();
    group.run(std::move(handle));
    group.wait();
    HandOver::take();
    HandOver::give();
  };
  const HandOver::Wait wait;
  if (threads == 0) {
    run_all();
  } else {
    arena_of(threads).execute(run_all);
  }
}

}  // namespace impinge::schedule
