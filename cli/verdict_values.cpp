// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "verdict_values.hpp"

#include <fmt/format.h>

#include <string_view>

#include "numbers.hpp"

namespace impinge::cli {

Result<void> take_tolerance(const std::string& text, std::optional<double>& to) {
  if (text.empty() || text == "auto") return {};
  to = parse_length(text);
  if (to) return {};
  return bad_option(
      fmt::format("--tolerance takes auto, or a length from 0 up in the files' unit such as 0.01, not '{}'", text));
}

Result<void> take_lengths(const Raw& raw, ClashArguments& to) {
  if (auto taken = take_tolerance(raw.tolerance, to.tolerance); !taken) return taken;
  if (raw.clearance.empty()) return {};
  const auto clearance = parse_length(raw.clearance);
  if (!clearance)
    return bad_option(
        fmt::format("--clearance takes a length from 0 up in the files' unit such as 2.5, not '{}'", raw.clearance));
  to.clearance = *clearance;
  return {};
}

Result<void> take_triage(const Raw& raw, ClashArguments& to) {
  if (!raw.config.empty()) to.config = raw.config;
  if (!raw.previous.empty()) to.previous = raw.previous;
  if (to.files.empty() && !to.config) return bad_option("no file to read is named; see impinge clash --help");
  if (raw.group_by.empty() || raw.group_by == "none") return {};
  if (raw.group_by == "part")
    to.group_by = GroupBy::part;
  else if (raw.group_by == "type")
    to.group_by = GroupBy::type;
  else if (raw.group_by == "test" && to.config)
    to.group_by = GroupBy::test;
  else if (raw.group_by == "test")
    return bad_option("--group-by test needs tests: name their file with --config FILE");
  else
    return bad_option(fmt::format("--group-by takes part, type, test or none, not '{}'", raw.group_by));
  return {};
}

Result<void> take_words(const std::vector<std::string>& lists, FailOn& to) {
  to = {};
  for (const std::string& list : lists) {
    std::string_view left = list;
    for (bool more = true; more;) {
      const std::size_t comma = left.find(',');
      const std::string_view word = left.substr(0, comma);
      more = comma != std::string_view::npos;
      if (more) left.remove_prefix(comma + 1);
      bool* const named = word == "contact"       ? &to.contact
                          : word == "penetration" ? &to.penetration
                          : word == "inside"      ? &to.inside
                          : word == "clearance"   ? &to.clearance
                          : word == "new"         ? &to.fresh
                                                  : nullptr;
      if (named == nullptr)
        return bad_option(
            fmt::format("--fail-on takes contact, penetration, inside, clearance or new, or several with commas "
                        "between them, not '{}'",
                        word));
      *named = true;
    }
  }
  return {};
}

Result<void> take_fail_on(const std::vector<std::string>& lists, ClashArguments& to) {
  if (lists.empty() && !to.config) return {};
  if (auto taken = take_words(lists, to.fail_on); !taken) return taken;
  const bool names_verdicts = to.fail_on.contact || to.fail_on.penetration || to.fail_on.inside || to.fail_on.clearance;
  if (to.config && names_verdicts)
    return bad_option("with --config, the mode of each test says what fails, and --fail-on takes new alone");
  if (to.fail_on.fresh && !to.previous)
    return bad_option("--fail-on new needs an earlier run to compare with: add --previous FILE, with its JSON");
  if (!names_verdicts) to.fail_on.penetration = to.fail_on.inside = !to.config;
  if (to.fail_on.clearance && to.clearance == 0)
    return bad_option("--fail-on clearance needs the distance to keep: add --clearance C, with C above 0");
  return {};
}

}  // namespace impinge::cli
