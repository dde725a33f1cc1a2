// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "tests/core/ways.hpp"

#include "tests/core/instruction_sets.hpp"

namespace impinge::test {
namespace {

std::vector<Way> make_all_ways() {
  std::vector<Way> ways;
  const auto add = [&](const char* backend, std::int64_t set) {
    for (const std::uint32_t leaf_size : {0u, 1u, 2u, 3u, 8u, 16u, 17u, 32u, 64u, 256u})
      for (const int threads : {1, 2, 8}) ways.push_back({backend, set, leaf_size, threads});
  };
  for (const std::int64_t set : instruction_sets()) add("simd", set);
  add("scalar", instruction_sets().front());
  return ways;
}

}  // namespace

std::string Way::name() const {
  return backend + ", leaf size " + std::to_string(leaf_size) + ", " + std::to_string(threads) + " threads";
}

const std::vector<Way>& all_ways() {
  static const std::vector<Way> ways = make_all_ways();
  return ways;
}

}  // namespace impinge::test
