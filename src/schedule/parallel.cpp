// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "schedule/parallel.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <mutex>

namespace impinge::schedule {

namespace {

int at_most_allowed(int threads) {
  const auto most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(std::min(static_cast<std::size_t>(threads), most));
}

}  // namespace

tbb::task_arena& arena_of(int threads) {
  static std::mutex mutex;
  // Never destroyed: at the program's end TBB may be gone before it.
  static auto& arenas = *new std::map<int, tbb::task_arena>;
  const std::lock_guard lock(mutex);
  const int size = at_most_allowed(threads);  // more would not run any faster, only make TBB print a warning
  return arenas.try_emplace(size, size).first->second;
}

int concurrency(int threads) {
  return threads == 0 ? tbb::this_task_arena::max_concurrency() : at_most_allowed(threads);
}

}  // namespace impinge::schedule
