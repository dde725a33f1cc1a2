// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace impinge::report {

/// Calls `work(i)` for each number below `count`, which are begun in this order, on at most so many threads; 0: all
/// there are. What `work` throws must not leave it.
template <class Work>
void share(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  const std::size_t all = threads > 0 ? static_cast<std::size_t>(threads) : std::thread::hardware_concurrency();
  std::vector<std::jthread> helpers;
  for (std::size_t i = 1; i < std::min(all, count); ++i) helpers.emplace_back(run);
  run();
}

}  // namespace impinge::report
