// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "kept.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>

namespace impinge::expected {
namespace {

/// From keys to words.
std::map<std::string, std::string> read_kept() {
  std::map<std::string, std::string> kept;
  std::ifstream in(IMPINGE_KEPT_ANSWERS);
  for (std::string line; std::getline(in, line);) {
    const std::size_t key_end = line.find(' '), name = line.find(" # ");
    if (!line.empty() && line.front() != '#' && name != std::string::npos)
      kept[line.substr(0, key_end)] = line.substr(key_end + 1, name - key_end - 1);
  }
  return kept;
}

std::string running_test() {
  const testing::TestInfo* const test = testing::UnitTest::GetInstance()->current_test_info();
  return std::string(test->test_suite_name()) + "." + test->name();
}

}  // namespace

std::string kept_answer(const std::string& key) {
  static const std::map<std::string, std::string> kept = read_kept();
  const auto found = kept.find(key);
  if (found != kept.end()) return found->second;
  ADD_FAILURE() << "No answer is kept in " << IMPINGE_KEPT_ANSWERS << " under " << key
                << ": the question is new, or has changed. To have the oracle answer it: scripts/keep_answers.sh";
  return {};
}

void hold_to_kept(const std::string& key, const std::string& answer) {
  static const char* const out = std::getenv("IMPINGE_ANSWERS_OUT");
  if (out != nullptr) {
    std::ofstream(out, std::ios::app) << key << ' ' << answer << " # " << running_test() << '\n';
    return;
  }
  EXPECT_EQ(kept_answer(key), answer) << "The oracle's answer is another one than is kept in " << IMPINGE_KEPT_ANSWERS
                                      << ". To write all anew: scripts/keep_answers.sh";
}

}  // namespace impinge::expected
