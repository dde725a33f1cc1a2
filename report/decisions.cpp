// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/decisions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "report/json_file.hpp"
#include "report/schemas.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

using nlohmann::json;

// People write this file; what is larger is another one.
constexpr std::uint64_t kMostBytesOfDecisions = 16'000'000;
constexpr std::size_t kMostValuesOfDecisions = 1'000'000;
constexpr std::string_view kBetweenNames = " | ";

bool is_bcf(std::string_view name) { return name.ends_with(".bcf") || name.ends_with(".bcfzip"); }

bool is_same(const Decision& p, const Decision& q) {
  return std::ranges::all_of(kDecisionFields,
                             [&](const auto& each) { return printable(p.*each.second) == printable(q.*each.second); });
}

/// What a document that is to be replaced holds: nothing where it is no table of decisions and no archive.
Result<Decisions> decisions_in(const std::string& name) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(name, unknown)) return Decisions();
  if (is_bcf(name)) {
    std::array<char, 2> begin{};
    std::ifstream(name, std::ios::binary).read(begin.data(), begin.size());
    return std::string_view(begin.data(), begin.size()) == "PK" ? read_decided_bcf(name) : Decisions();
  }
  const Result<std::string> text = read_text_file(name, kMostBytesOfTable);
  if (!text) return text.error();
  return is_decided_table(*text) ? parse_decided_table(name, *text) : Decisions();
}

}  // namespace

bool is_empty(const Decision& decision) {
  return std::ranges::all_of(kDecisionFields, [&](const auto& each) { return (decision.*each.second).empty(); });
}

bool Decisions::add(const std::string& id, const Decision& decision) {
  return is_empty(decision) || is_same(by_id.emplace(id, decision).first->second, decision);
}

bool is_day(std::string_view text) {
  constexpr std::string_view kShape = "0000-00-00";
  const auto is_as_shaped = [](char shape, char c) { return shape == '0' ? c >= '0' && c <= '9' : c == shape; };
  if (!std::ranges::equal(kShape, text, is_as_shaped)) return false;
  const auto number = [&](std::size_t at) { return static_cast<unsigned>(10 * (text[at] - '0') + text[at + 1] - '0'); };
  const std::chrono::year year(static_cast<int>(100 * number(0) + number(2)));
  return year > std::chrono::year(0) && (year / std::chrono::month(number(5)) / std::chrono::day(number(8))).ok();
}

bool is_pair_id(std::string_view key) {
  constexpr std::size_t kLengthOfUuid = 36;
  return key.size() == kLengthOfUuid && key.find_first_not_of("0123456789abcdef-") == std::string_view::npos;
}

Result<Decisions> parse_decisions(const std::string& name, const std::string& text) {
  static const json schema = json::parse(kDecisionsSchema);
  // Patterns count in the order of the file, which `json` does not keep. Keys within decisions are among these too.
  std::vector<std::string> keys;
  const auto note_key = [&](const std::string& key) { return keys.push_back(key), true; };
  const Result<json> value = parse_json(name, text, note_key, kMostValuesOfDecisions);
  if (!value) return value.error();
  if (auto valid = check_against(schema, name, text, *value); !valid) return valid.error();
  Decisions decisions;
  for (const std::string& key : keys) {
    const auto entry = value->find(key);
    if (key == "$schema" || entry == value->end()) continue;
    const std::size_t bar = key.find(kBetweenNames);
    if (bar == std::string::npos && !is_pair_id(key))
      return json_error(name, text, (json::json_pointer() / key).to_string(),
                        "this is neither the id of a pair, as the JSON has it, nor two names of parts with ' | ' "
                        "between them");
    Decision decision;
    for (const auto& [member, field] : kDecisionFields) decision.*field = entry->value(member, "");
    if (!decision.due.empty() && !is_day(decision.due))
      return json_error(name, text, (json::json_pointer() / key / "due").to_string(),
                        fmt::format("a day is such as 2024-06-14, not '{}'", fit(printable(decision.due), 80)));
    if (bar == std::string::npos)
      decisions.by_id.emplace(key, decision);
    else
      decisions.by_names.push_back({key, key.substr(0, bar), key.substr(bar + kBetweenNames.size()), decision});
  }
  return decisions;
}

Result<Decisions> read_decisions(const std::string& name) {
  if (is_bcf(name)) return read_decided_bcf(name);
  const bool is_table = name.ends_with(".csv");
  const Result<std::string> text = read_text_file(name, is_table ? kMostBytesOfTable : kMostBytesOfDecisions);
  if (!text) return text.error();
  return is_table ? parse_decided_table(name, *text) : parse_decisions(name, *text);
}

std::vector<std::string> decide(const Decisions& decisions, Review& review) {
  std::vector<std::string> unmatched;
  std::vector<bool> is_decided(review.ids.size());
  std::unordered_map<std::string_view, std::size_t> pairs;
  for (std::size_t i = 0; i < review.ids.size(); ++i) pairs.emplace(review.ids[i], i);
  for (const auto& [id, decision] : decisions.by_id) {
    review.decisions.emplace_back(id, decision);
    const auto pair = pairs.find(id);
    if (pair == pairs.end()) {
      unmatched.push_back(id);
    } else {
      review.standings[pair->second].decision = decision;
      is_decided[pair->second] = true;
    }
  }
  const Assembly& assembly = review.assembly;
  const auto parts_named = [&](const std::string& pattern) {
    std::vector<bool> named(assembly.objects.size());
    for (std::size_t i = 0; i < named.size(); ++i)
      named[i] = matches_pattern(pattern, assembly.objects[i].name) || matches_pattern(pattern, assembly.labels[i]);
    return named;
  };
  for (const Decisions::ByNames& entry : decisions.by_names) {
    if (review.options.stop.stop_requested()) break;
    review.decisions.emplace_back(entry.key, entry.decision);
    const std::vector<bool> a = parts_named(entry.a), b = parts_named(entry.b);
    bool is_matched = false;
    for (std::size_t i = 0; i < is_decided.size(); ++i) {
      const auto [first, second] = review.clashes.pairs[i].objects;
      if (!(a[first] && b[second]) && !(a[second] && b[first])) continue;
      is_matched = true;
      if (!is_decided[i]) review.standings[i].decision = entry.decision;
      is_decided[i] = true;
    }
    if (!is_matched) unmatched.push_back(entry.key);
  }
  return unmatched;
}

Result<void> check_replaced(const std::string& name, const Decisions& given, const Review& review) {
  const Result<Decisions> earlier = decisions_in(name);
  if (!earlier) return earlier.error();
  std::unordered_map<std::string_view, const Decision*> shown;
  for (std::size_t i = 0; i < review.ids.size(); ++i) shown.emplace(review.ids[i], &review.standings[i].decision);
  // A topic without a day of its own gets that of `--due`; a day that is only added loses nothing.
  const std::string due_of_all = review.options.due.substr(0, std::string_view("2024-06-14").size());
  const auto same = [&](const Decision& earlier_one, Decision other) {
    if (is_bcf(name) && (earlier_one.due.empty() || earlier_one.due == due_of_all)) other.due = earlier_one.due;
    return is_same(earlier_one, other);
  };
  // Of a pair that is gone the new document says nothing: what only the earlier one says would be lost.
  const auto is_given = [&](const std::string& id, const Decision& decision) {
    const auto same_id = given.by_id.find(id);
    if (same_id != given.by_id.end() && same(decision, same_id->second)) return true;
    return std::any_of(given.by_names.begin(), given.by_names.end(),
                       [&](const Decisions::ByNames& entry) { return same(decision, entry.decision); });
  };
  // A day alone is most often that of an earlier run's `--due`.
  const auto is_day_alone = [](Decision decision) {
    decision.due.clear();
    return is_empty(decision);
  };
  std::size_t lost = 0;
  std::string first;
  for (const auto& [id, decision] : earlier->by_id) {
    if (is_bcf(name) && is_day_alone(decision)) continue;
    const auto pair = shown.find(id);
    if (pair != shown.end() ? same(decision, *pair->second) : is_given(id, decision)) continue;
    if (lost++ == 0) first = id;
  }
  if (lost == 0) return {};
  return Error{Code::bad_file,
               fmt::format("{} holds {} that would be lost, the first about the pair {}; write to another file and "
                           "give this one to --decisions, or replace it with --force",
                           name, counted(lost, "decision"), first)};
}

}  // namespace impinge::report
