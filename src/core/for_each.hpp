// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace impinge {

/// Runs body(0) to body(n - 1), in any order and perhaps at once, and returns when all are done. The stages know
/// nothing of threads: whoever calls one says how. Meanwhile the calling thread does nothing else, so it may hold what
/// others wait for. Empty: one after the other.
using ForEach = std::function<void(std::size_t n, const std::function<void(std::size_t)>& body)>;

template <class Body>
void run_each(const ForEach& for_each, std::size_t n, const Body& body) {
  if (for_each && n > 1) return for_each(n, body);
  for (std::size_t i = 0; i < n; ++i) body(i);
}

}  // namespace impinge
