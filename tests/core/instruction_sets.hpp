// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

/// The library chooses among instruction sets when it runs; tests have it use each of them in turn.
namespace impinge::test {

/// Those that it was compiled for and this machine has, the plainest among them.
std::vector<std::int64_t> instruction_sets();
std::string instruction_set_name(std::int64_t set);

/// While it lives, the library uses this one, and what fails names it. To be made and ended while no query runs.
class OnInstructionSet {
 public:
  explicit OnInstructionSet(std::int64_t set, const char* file = __builtin_FILE(), int line = __builtin_LINE());
  ~OnInstructionSet();
  OnInstructionSet(const OnInstructionSet&) = delete;
  OnInstructionSet& operator=(const OnInstructionSet&) = delete;

 private:
  testing::ScopedTrace trace_;
};

}  // namespace impinge::test
