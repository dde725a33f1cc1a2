// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "report/assembly.hpp"
#include "report/named_tests/configuration.hpp"

namespace impinge::report {

/// What the groups of a configuration are in an assembly.
class PartSets {
 public:
  PartSets(const Configuration& configuration, const Assembly& assembly)
      : configuration_(configuration), assembly_(assembly) {}

  /// Errors: `bad_file` (a word that names nothing, with the nearest name; a group without parts, or of itself; more
  /// words than can be looked up in a reasonable time).
  Result<PartSet> of(const Group& group);

 private:
  Result<void> count_word(const Word& word);
  Result<PartSet> of_word(const Word& word, const std::vector<Word> Group::*list);
  Result<PartSet> of_named(const Word& word);
  Result<PartSet> with_property(const PropertyWords& property, const std::string& place);
  Result<PartSet> any_of(const std::vector<Group>& groups);
  [[nodiscard]] Error nothing_named(const Word& word, std::string_view what, const std::string& nearest) const;

  const Configuration& configuration_;
  const Assembly& assembly_;
  std::map<std::string, PartSet> known_;
  std::vector<std::string> open_;  ///< the groups that are being made
  std::size_t words_ = 0;
};

/// What a group is in short, for people: "pipe*, file steel.glb".
std::string in_short(const Group& group);

}  // namespace impinge::report
