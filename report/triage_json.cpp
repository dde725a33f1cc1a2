// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/triage_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "report/json_writer.hpp"

namespace impinge::report {
namespace {

/// null for what nobody wrote.
std::string json_text(const std::string& text) { return text.empty() ? "null" : json_string(text); }

std::string json_remark(const Remark& remark) {
  return fmt::format("\"status\":{},\"comment\":{}", json_text(remark.status), json_text(remark.comment));
}

std::string_view json_change(Change change) {
  switch (change) {
    case Change::unknown:
      return "null";
    case Change::fresh:
      return "\"new\"";
    case Change::persisting:
      return "\"persisting\"";
  }
  return "null";
}

std::string json_centroid(const Resolved& resolved) {
  return resolved.centroid ? json_point(*resolved.centroid) : "null";
}

std::string json_old_part(const OldPart& part) {
  return fmt::format("{{\"name\":{},\"path\":{},\"file\":{},\"placed\":{}}}", json_string(part.name),
                     json_string(part.path), json_string(part.file), json_text(part.placed));
}

std::string json_old_region(const Resolved& region) {
  return fmt::format("{{\"region\":{},\"centroid\":{},\"reach\":{},{}}}", json_text(region.region),
                     json_centroid(region), json_number(region.reach), json_remark(region.remark));
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

std::string json_triage(const Review& review, std::size_t pair) {
  const Standing& standing = review.standings[pair];
  const std::vector<PlannedTest>& tests = review.plan.tests();
  return fmt::format("\"test\":{},{},\"was\":{},\"ambiguous\":{}",
                     tests.empty() ? "null" : json_string(tests[review.clashes.pairs[pair].test].name),
                     json_standing(standing.change, standing.remark),
                     standing.was ? fmt::format("\"{}\"", name(*standing.was)) : "null", bool{review.ambiguous[pair]});
}

std::string json_standing(Change change, const Remark& remark) {
  return fmt::format("\"change\":{},{}", json_change(change), json_remark(remark));
}

void write_tests(Sink& sink, const Review& review) {
  const std::vector<PlannedTest>& tests = review.plan.tests();
  std::vector<std::uint64_t> counts(tests.size()), failing(tests.size());
  for (std::size_t i = 0; !tests.empty() && i < review.clashes.pairs.size(); ++i) {
    ++counts[review.clashes.pairs[i].test];
    failing[review.clashes.pairs[i].test] += review.standings[i].fails ? 1 : 0;
  }
  sink.write("\"tests\":[");
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const PlannedTest& test = tests[i];
    sink.write(fmt::format(
        "{}\n{{\"name\":{},\"mode\":\"{}\",\"tolerance\":{},\"clearance\":{},\"a\":{},\"b\":{},", i > 0 ? "," : "",
        json_string(test.name), name(test.mode), test.tolerance ? json_number(*test.tolerance) : "\"auto\"",
        test.clearance > 0 ? json_number(test.clearance) : "null", json_string(test.a), json_text(test.b)));
    sink.write(fmt::format("\"parts_a\":{},\"parts_b\":{},\"count\":{},\"fail\":{}}}", test.parts_a, test.parts_b,
                           counts[i], failing[i]));
  }
  sink.write("],\n");
}

void write_types(Sink& sink, const Review& review) {
  sink.write("\"types\":[");
  for (std::size_t i = 0; i < review.types.types.size(); ++i)
    sink.write(fmt::format("{}\n{{\"name\":{},\"parts\":{}}}", i > 0 ? "," : "",
                           json_string(review.types.types[i].name), review.types.types[i].parts));
  sink.write("],\n");
}

void write_resolved(Sink& sink, const Review& review) {
  sink.write("\"resolved\":[");
  for (std::size_t i = 0; i < review.resolved.size(); ++i) {
    const Resolved& resolved = review.resolved[i];
    sink.write(fmt::format("{}\n{{\"id\":{},\"region\":{},\"a\":{},\"b\":{},\"test\":{},\"verdict\":\"{}\",",
                           i > 0 ? "," : "", json_string(resolved.id), json_text(resolved.region),
                           json_old_part(resolved.a), json_old_part(resolved.b), json_text(resolved.test),
                           name(resolved.verdict)));
    sink.write(fmt::format("\"centroid\":{},\"reach\":{},{},\"ambiguous\":{},\"regions\":{}}}", json_centroid(resolved),
                           json_number(resolved.reach), json_remark(resolved.remark), resolved.is_ambiguous,
                           json_list(resolved.regions, json_old_region)));
  }
  sink.write("],\n");
}

void write_groups(Sink& sink, const Review& review, GroupBy by) {
  if (by == GroupBy::none) return sink.write("\"groups\":null,\n");
  const auto number = [](std::size_t pair) { return fmt::format("{}", pair); };
  sink.write(fmt::format("\"groups\":{{\"by\":\"{}\",\"list\":[", json_word(by)));
  bool is_first = true;
  for (const PairGroup& group : groups_of(by, review.clashes.pairs, ranked(review.clashes.pairs), review.types)) {
    sink.write(fmt::format("{}\n{{\"a\":{},\"b\":{},\"fail\":{},\"pairs\":{}}}", is_first ? "" : ",", group.a,
                           group.b ? fmt::format("{}", *group.b) : "null", count_failing(review, group.pairs),
                           json_list(group.pairs, number)));
    is_first = false;
  }
  sink.write("]},\n");
}

}  // namespace impinge::report
