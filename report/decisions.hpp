// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "impinge/result.hpp"
#include "report/review.hpp"

/// What people decided about pairs: a file that they own, and that is only read (docs/triage.md, "Decisions").
namespace impinge::report {

struct Decisions {
  /// Of all pairs of a part that the one pattern describes and a part that the other one does.
  struct ByNames {
    std::string key;  ///< as it stands in the file
    std::string a, b;
    Decision decision;
  };
  std::map<std::string, Decision> by_id;  ///< by the pairs' ids
  std::vector<ByNames> by_names;          ///< in the order of the file
};

/// Errors: `bad_file`, with the line and the place.
Result<Decisions> read_decisions(const std::string& name);
Result<Decisions> parse_decisions(const std::string& name, const std::string& text);

/// Gives each pair the decision about its id, or else the first one about its parts' names. Returns the keys that match
/// no pair.
std::vector<std::string> decide(const Decisions& decisions, Review& review);

}  // namespace impinge::report
