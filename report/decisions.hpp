// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "impinge/result.hpp"
#include "report/review.hpp"

/// What people decided about pairs: a file that they own, and that is only read (docs/triage.md, "Decisions").
namespace impinge::report {

/// What is larger was not written by people.
inline constexpr std::uint64_t kMostBytesOfTable = 256'000'000;

struct Decisions {
  /// Of all pairs of a part that the one pattern describes and a part that the other one does.
  struct ByNames {
    std::string key;  ///< as it stands in the file
    std::string a, b;
    Decision decision;
  };
  std::map<std::string, Decision> by_id;  ///< by the pairs' ids
  std::vector<ByNames> by_names;          ///< in the order of the file

  /// False if another one decides otherwise about the pair. An empty decision decides nothing.
  bool add(const std::string& id, const Decision& decision);
};

/// From JSON; from a table with columns as `write_csv` has them if the name ends in ".csv"; or from BCF if it ends in
/// ".bcf" or ".bcfzip". Errors: `bad_file`, with the line and the place.
Result<Decisions> read_decisions(const std::string& name);
Result<Decisions> parse_decisions(const std::string& name, const std::string& text);
/// Rows without a status, a comment, an assignee and a day decide nothing.
Result<Decisions> parse_decided_table(const std::string& name, const std::string& text);
/// Whether a text has the columns of a table of decisions.
bool is_decided_table(const std::string& text);
/// Status, comments, assignee and due day of the topics of BCF 2.0 to 3.0, whose GUIDs are ids of pairs. Errors: also
/// of an archive that unpacks to more than people write.
Result<Decisions> read_decided_bcf(const std::string& name);

bool is_empty(const Decision& decision);

/// Whether a text is a day such as 2024-06-14 (ISO 8601).
bool is_day(std::string_view text);

/// Whether a text looks like the id of a pair.
bool is_pair_id(std::string_view key);

/// Gives each pair the decision about its id, or else the first one about its parts' names. Returns the keys that match
/// no pair. Ends early where the review's `stop` asks for it.
std::vector<std::string> decide(const Decisions& decisions, Review& review);

/// Whether a new table or BCF of the review, whose decisions are those given, may take an earlier one's place. Errors:
/// `bad_file`, where it holds decisions that the new one would not.
Result<void> check_replaced(const std::string& name, const Decisions& given, const Review& review);

}  // namespace impinge::report
