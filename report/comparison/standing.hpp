// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "impinge/clash.hpp"

/// What a review says of a clash beside its verdict: whether it fails, whether it is new, and what people decided.
namespace impinge::report {

/// Since the previous run.
enum class Change : std::uint8_t {
  unknown,  ///< there is no previous run
  fresh,    ///< the previous run did not list it; or it did not fail then, and does now
  persisting,
};

/// What people decided about a pair, in their own words.
struct Decision {
  std::string status, comment, assignee;
  std::string due;  ///< a day, such as 2024-06-14
};
/// Its fields, by their names in JSON and CSV.
inline constexpr std::array<std::pair<const char*, std::string Decision::*>, 4> kDecisionFields{
    {{"status", &Decision::status},
     {"comment", &Decision::comment},
     {"assignee", &Decision::assignee},
     {"due", &Decision::due}}};

struct RegionStanding {
  std::string id;
  Change change = Change::unknown;
};

/// Of a pair.
struct Standing {
  bool fails = false;
  Change change = Change::unknown;
  std::optional<Verdict> was;  ///< in the previous run
  Decision decision;
  std::vector<RegionStanding> regions;  ///< in the order of the pair's own
};

/// A part of the previous run, which need not exist any more.
struct OldPart {
  std::string name, path, file;
  std::string placed;      ///< as `Identity::placed`; empty where the report does not say
  std::string key{};       ///< as `Identity::key`, as JSON has it; likewise
  std::string known_as{};  ///< by which it was known, if not by that
};

/// A clash of the previous run that this run does not find: a pair, or one region of a pair that it does find.
struct Resolved {
  std::string id;      ///< the pair's
  std::string region;  ///< the region's id; empty: the whole pair
  OldPart a, b;
  std::string test;  ///< empty: none
  Verdict verdict = Verdict::apart;
  std::optional<Point> centroid;
};

}  // namespace impinge::report
