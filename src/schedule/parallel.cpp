// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "schedule/parallel.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <mutex>

namespace impinge::schedule {

tbb::task_arena& arena_of(int threads) {
  // More than TBB allows would not run any faster, only make it print a warning.
  const auto most = static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  static std::mutex mutex;
  // Never destroyed: at the program's end TBB may be gone before it.
  static auto& arenas = *new std::map<int, tbb::task_arena>;
  const std::lock_guard lock(mutex);
  const int size = std::min(threads, most);
  return arenas.try_emplace(size, size).first->second;
}

int concurrency(int threads) { return threads == 0 ? tbb::this_task_arena::max_concurrency() : threads; }

}  // namespace impinge::schedule
