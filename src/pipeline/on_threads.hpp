// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/for_each.hpp"
#include "schedule/parallel.hpp"

namespace impinge {

/// Lets a stage share work among up to so many threads (0: all there are).
inline ForEach on_threads(int threads) {
  if (threads == 1) return {};
  return
      [threads](std::size_t n, const std::function<void(std::size_t)>& body) { schedule::for_each(n, threads, body); };
}

}  // namespace impinge
