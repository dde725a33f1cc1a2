// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "io/readers.hpp"

namespace impinge::io {
namespace {

/// Ends the process: 0 if the reader says that memory ran out, with 64 MiB left of it.
[[noreturn]] void read_with_little_memory(const std::string& bytes) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t most = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (64 << 20);
  const rlimit limit{most, most};
  setrlimit(RLIMIT_AS, &limit);
  const Result<Model> model = read_off(bytes, "large.off");
  std::_Exit(!model && model.error().code == Code::out_of_memory ? 0 : 1);
}

TEST(Reader, MemoryThatRunsOutIsAnError) {
  std::string bytes = "OFF\n5000000 0 0\n";  // 120 MB of vertices
  for (int i = 0; i < 5'000'000; ++i) bytes += "0 0 0\n";
  EXPECT_EXIT(read_with_little_memory(bytes), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace impinge::io
