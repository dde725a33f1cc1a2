// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/float_environment.hpp"

namespace impinge::schedule {

/// One T a thread, made when the thread first asks.
template <class T>
using PerWorker = tbb::enumerable_thread_specific<T>;

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
  // More than TBB allows would not run any faster, only make it print a warning.
  const auto most = static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  tbb::task_arena arena(threads == 0 ? most : std::min(threads, most));
  arena.execute([&] {
    tbb::task_group group;
    const auto run = [&](const auto& self, Task task) -> void {
      const FloatEnvironment nearest;  // each worker has its own
      body(task, [&](Task spawned) { group.run([&self, t = std::move(spawned)] { self(self, t); }); });
    };
    group.run([&] {
      tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) { run(run, std::move(tasks[i])); });
    });
    group.wait();
  });
}

}  // namespace impinge::schedule
