// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/triage_json.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace impinge::report {
namespace {

Json json_old_part(const OldPart& part) { return {{"name", part.name}, {"path", part.path}, {"file", part.file}}; }

Json json_resolved(const Resolved& resolved) {
  return {{"id", resolved.id},
          {"region", or_null(resolved.region)},
          {"a", json_old_part(resolved.a)},
          {"b", json_old_part(resolved.b)},
          {"test", or_null(resolved.test)},
          {"verdict", name(resolved.verdict)},
          {"centroid", resolved.centroid ? json_point(*resolved.centroid) : Json()}};
}

std::string_view json_word(GroupBy by) {
  switch (by) {
    case GroupBy::part:
      return "part";
    case GroupBy::type:
      return "type";
    case GroupBy::test:
      return "test";
    case GroupBy::none:
      break;
  }
  return "none";
}

std::uint64_t count_failing(const Review& review, const std::vector<std::size_t>& pairs) {
  return static_cast<std::uint64_t>(
      std::count_if(pairs.begin(), pairs.end(), [&](std::size_t i) { return review.standings[i].fails; }));
}

}  // namespace

Json json_change(Change change) {
  switch (change) {
    case Change::unknown:
      break;
    case Change::fresh:
      return "new";
    case Change::persisting:
      return "persisting";
  }
  return {};
}

Json json_triage(const Review& review, std::size_t pair) {
  const Standing& standing = review.standings[pair];
  const std::vector<PlannedTest>& tests = review.plan.tests();
  return {{"test", tests.empty() ? Json() : Json(tests[review.clashes.pairs[pair].test].name)},
          {"change", json_change(standing.change)},
          {"status", or_null(standing.decision.status)},
          {"comment", or_null(standing.decision.comment)},
          {"was", standing.was ? Json(name(*standing.was)) : Json()}};
}

void write_tests(JsonDocument& document, const Review& review) {
  const std::vector<PlannedTest>& tests = review.plan.tests();
  std::vector<std::uint64_t> counts(tests.size()), failing(tests.size());
  for (std::size_t i = 0; !tests.empty() && i < review.clashes.pairs.size(); ++i) {
    ++counts[review.clashes.pairs[i].test];
    failing[review.clashes.pairs[i].test] += review.standings[i].fails ? 1 : 0;
  }
  document.list("tests", tests.size(), [&](std::size_t i) {
    const PlannedTest& test = tests[i];
    return Json{{"name", test.name},
                {"mode", name(test.mode)},
                {"tolerance", json_tolerance(test.tolerance)},
                {"clearance", test.clearance > 0 ? Json(test.clearance) : Json()},
                {"a", test.a},
                {"b", or_null(test.b)},
                {"parts_a", test.parts_a},
                {"parts_b", test.parts_b},
                {"count", counts[i]},
                {"fail", failing[i]}};
  });
}

void write_types(JsonDocument& document, const Review& review) {
  const auto& types = review.types.types;
  document.list("types", types.size(), [&](std::size_t i) {
    return Json{{"name", types[i].name}, {"parts", types[i].parts}};
  });
}

void write_resolved(JsonDocument& document, const Review& review) {
  document.list("resolved", review.resolved.size(), [&](std::size_t i) { return json_resolved(review.resolved[i]); });
}

void write_groups(JsonDocument& document, const Review& review, GroupBy by) {
  if (by == GroupBy::none) return document.member("groups", nullptr);
  Json list = Json::array();
  for (const PairGroup& group : groups_of(by, review.clashes.pairs, ranked(review.clashes.pairs), review.types))
    list.push_back(Json{
        {"a", group.a}, {"b", or_null(group.b)}, {"fail", count_failing(review, group.pairs)}, {"pairs", group.pairs}});
  document.member("groups", Json{{"by", json_word(by)}, {"list", std::move(list)}});
}

}  // namespace impinge::report
