// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "kept_verdicts.hpp"

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <sstream>

namespace impinge::expected {
namespace {

/// One in so many is computed anew: some 40 of the 972 pairs.
constexpr std::uint64_t kOneIn = 24;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

/// A line is a key, the number of impinge::Verdict, which one is inside (or -1), and the pair's name, for readers.
std::map<std::string, scenes::Judgement> read_kept() {
  std::map<std::string, scenes::Judgement> kept;
  if (!environment("IMPINGE_VERDICTS_OUT").empty()) {
    return kept;
  }
  std::ifstream in(IMPINGE_KEPT_VERDICTS);
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    std::string key;
    int verdict = 0, inner = 0;
    if (line.front() != '#' && fields >> key >> verdict >> inner) {
      kept[key] = {static_cast<Verdict>(verdict), inner};
    }
  }
  return kept;
}

std::uint64_t drawn_seed() {
  const std::string wanted = environment("IMPINGE_VERDICTS_ANEW");
  const std::uint64_t seed = wanted.empty() ? std::random_device()() : std::strtoull(wanted.c_str(), nullptr, 10);
  std::cout << "Which kept verdicts are computed anew is drawn by IMPINGE_VERDICTS_ANEW=" << seed << '\n';
  return seed;
}

}  // namespace

std::optional<scenes::Judgement> kept_verdict(const std::string& key) {
  static const std::map<std::string, scenes::Judgement> kept = read_kept();
  const auto found = kept.find(key);
  return found != kept.end() ? std::optional(found->second) : std::nullopt;
}

bool is_computed_anew(const std::string& key) {
  static const bool all = environment("IMPINGE_VERDICTS_ANEW") == "all";
  if (all) {
    return true;
  }
  static const std::uint64_t seed = drawn_seed();
  // The key begins with a good hash of its own.
  const std::uint64_t hash = std::strtoull(key.c_str(), nullptr, 16);
  return std::mt19937_64(seed ^ hash)() % kOneIn == 0;
}

void write_down(const std::string& key, const std::string& name, const scenes::Judgement& judgement) {
  static const std::string file = environment("IMPINGE_VERDICTS_OUT");
  if (!file.empty()) {
    std::ofstream(file, std::ios::app) << key << ' ' << static_cast<int>(judgement.verdict) << ' ' << judgement.inner
                                       << ' ' << name << '\n';
  }
}

}  // namespace impinge::expected
