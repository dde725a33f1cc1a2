// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "broad/for_each.hpp"
#include "schedule/parallel.hpp"

namespace impinge {

/// Lets a stage share work among up to so many threads (0: all there are).
inline broad::ForEach on_threads(int threads) {
  if (threads == 1) return {};
  return [threads](std::size_t n, const std::function<void(std::size_t)>& body) {
    std::vector<std::size_t> tasks(n);
    std::iota(tasks.begin(), tasks.end(), std::size_t{0});
    schedule::run_tasks(std::move(tasks), threads, [&](std::size_t i, const auto&) { body(i); });
  };
}

}  // namespace impinge
