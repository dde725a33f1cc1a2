// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "impinge/options.hpp"

namespace impinge::test {

/// A way to come by an answer, none of which may change it (contract 3.1).
struct Way {
  std::string backend;
  std::int64_t instruction_set;
  std::uint32_t leaf_size;
  int threads;

  [[nodiscard]] Options options() const { return {.threads = threads, .backend = backend}; }
  /// For the trace of what fails; the instruction set tells its own name.
  [[nodiscard]] std::string name() const;
};

/// Every backend on every instruction set that it may run on, with every leaf size and number of threads.
const std::vector<Way>& all_ways();

}  // namespace impinge::test
