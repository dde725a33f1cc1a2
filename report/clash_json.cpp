// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <utility>

#include "report/json_writer.hpp"
#include "report/units.hpp"
#include "report/writers.hpp"

namespace impinge::report {
namespace {

Json json_settings(const ReportOptions& options) {
  return {{"tolerance", json_tolerance(value_of(options.tolerance))},
          {"clearance", options.clearance.value},
          {"depth_precision", json_finite(options.depth_precision)},
          {"regions", options.regions},
          {"volumes", options.volumes},
          {"fail_on", words_of(options.fail_on)},
          {"ignore", options.ignored},
          {"between", options.between ? Json{options.between->first, options.between->second} : Json()},
          {"within_products", options.within_products},
          {"scale", options.scales},
          {"config", or_null(options.config)},
          {"previous", or_null(options.previous)},
          {"decisions", or_null(options.decisions)}};
}

Json json_part(const Review& review, std::size_t i) {
  Json part = json_identity(review.assembly, i);
  const std::string& key = review.identities[i].key;
  part.update(Json{{"placed", review.identities[i].placed},
                   {"key", key},
                   {"known_as", review.known_keys[i] == key ? Json() : Json(review.known_keys[i])},
                   {"closed", review.parts[i].facts.closed},
                   {"open_edges", review.parts[i].facts.open_edges}});
  part.update(json_facts(review.parts[i]));
  part["type"] = review.types.of_object[i];
  return part;
}

/// Members of a pair. Null of what touches: where it does, the regions tell.
Json json_distance(const std::optional<Nearest>& nearest) {
  if (!nearest) return {{"distance", nullptr}, {"distance_error", nullptr}, {"nearest", nullptr}};
  return {{"distance", nearest->distance},
          {"distance_error", nearest->error},
          {"nearest", {json_point(nearest->a), json_point(nearest->b)}}};
}

Json json_region(const Region& region, const RegionStanding& standing) {
  Json lines = Json::array();
  for (const std::vector<Point>& line : region.lines) lines.push_back(json_points(line));
  return {{"id", standing.id},
          {"change", or_null(name(standing.change))},
          {"pairs", region.pairs},
          {"box", json_points(region.box)},
          {"area", region.area},
          {"length", region.length},
          {"centroid", json_point(region.centroid)},
          {"normal", json_point(region.normal)},
          {"lines", std::move(lines)},
          {"triangles_a", region.triangles_a},
          {"triangles_b", region.triangles_b}};
}

Json json_pair(const Review& review, std::size_t number) {
  const ReportOptions& options = review.options;
  const Clash& pair = review.clashes.pairs[number];
  const Standing& standing = review.standings[number];
  const bool has_inner = pair.verdict == Verdict::inside && pair.inner >= 0;
  Json json{{"id", review.ids[number]},
            {"a", pair.objects[0]},
            {"b", pair.objects[1]},
            {"crossing", pair.contacts[0]},
            {"touching", pair.contacts[1]},
            {"coplanar", pair.contacts[2]},
            {"verdict", name(pair.verdict)},
            {"inner", has_inner ? Json(pair.objects[static_cast<std::size_t>(pair.inner)]) : Json()},
            {"note", pair.note == Note::none ? Json() : Json(sentence(pair.note))},
            {"tolerance", pair.tolerance},
            {"incomplete", or_null(incomplete_sides(review, pair))},
            {"fails", standing.fails},
            {"fails_below", json_finite(pair.fails_below)},
            {"overlap_depth", json_depth(pair.overlap_depth)},
            {"axes", or_null(review.axes[number])}};
  json.update(json_triage(review, number));
  if (options.clearance.value > 0) json.update(json_distance(pair.nearest));
  if (options.volumes) {
    json["overlap_volume"] = pair.overlap_volume ? Json(pair.overlap_volume->volume) : Json();
    json["overlap_volume_error"] = pair.overlap_volume ? Json(pair.overlap_volume->error) : Json();
  }
  if (!options.regions) return json;
  Json& regions = json["regions"] = Json::array();
  for (std::size_t i = 0; i < pair.regions.size(); ++i)
    regions.push_back(json_region(pair.regions[i], standing.regions[i]));
  return json;
}

Json json_counts(const Review& review) {
  std::array<std::uint64_t, 6> counts{};
  for (const Clash& pair : review.clashes.pairs) ++counts[static_cast<std::size_t>(pair.verdict)];
  Json json;
  for (std::size_t i = 0; i < counts.size(); ++i) json[std::string(name(static_cast<Verdict>(i)))] = counts[i];
  json["fail"] = count_failing(review);
  json["candidates"] = review.clashes.candidates;
  return json;
}

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

std::uint64_t count_failing(const Review& review, const std::vector<std::size_t>& pairs) {
  return static_cast<std::uint64_t>(
      std::count_if(pairs.begin(), pairs.end(), [&](std::size_t i) { return review.standings[i].fails; }));
}

/// As a file of decisions has them, without what is empty.
Json json_decisions(const Review& review) {
  Json all = Json::object();
  // No key is there twice, and `all[key]` would compare each with all before it.
  auto& members = all.get_ref<Json::object_t&>();
  members.reserve(review.decisions.size());
  for (const auto& [key, decision] : review.decisions) {
    Json& entry = members.emplace_back(key, Json::object()).second;
    for (const auto& [name, field] : kDecisionFields)
      if (!(decision.*field).empty()) entry[name] = decision.*field;
  }
  return all;
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
    Json left_out = Json::object();
    for (const auto& [rule, pairs] : review.plan.left_out(static_cast<std::uint32_t>(i)))
      left_out[std::string(rule)] = pairs;
    return Json{{"name", test.name},
                {"mode", name(test.mode)},
                {"tolerance", json_tolerance(test.tolerance)},
                {"clearance", test.clearance > 0 ? Json(test.clearance) : Json()},
                {"a", test.a},
                {"b", or_null(test.b)},
                {"parts_a", test.parts_a},
                {"parts_b", test.parts_b},
                {"left_out", std::move(left_out)},
                {"count", counts[i]},
                {"fail", failing[i]}};
  });
}

/// Why a file was skipped; null of one that was read.
Json error_of(const Assembly& assembly, const std::string& file) {
  const auto at = std::ranges::find(assembly.skipped, file);
  if (at == assembly.skipped.end()) return {};
  return assembly.missing[assembly.missing.size() - static_cast<std::size_t>(assembly.skipped.end() - at)];
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

void write_groups(JsonDocument& document, const Review& review) {
  constexpr std::array<const char*, 4> kWords{"none", "part", "type", "test"};
  const GroupBy by = review.options.group_by;
  if (by == GroupBy::none) return document.member("groups", nullptr);
  Json list = Json::array();
  for (const PairGroup& group : groups_of(by, review.clashes.pairs, ranked(review.clashes.pairs), review.types))
    list.push_back(Json{
        {"a", group.a}, {"b", or_null(group.b)}, {"fail", count_failing(review, group.pairs)}, {"pairs", group.pairs}});
  document.member("groups", Json{{"by", kWords[static_cast<std::size_t>(by)]}, {"list", std::move(list)}});
}

}  // namespace

Json json_triage(const Review& review, std::size_t pair) {
  const Standing& standing = review.standings[pair];
  const std::vector<PlannedTest>& tests = review.plan.tests();
  return {{"test", tests.empty() ? Json() : Json(tests[review.clashes.pairs[pair].test].name)},
          {"change", or_null(name(standing.change))},
          {"status", or_null(standing.decision.status)},
          {"comment", or_null(standing.decision.comment)},
          {"assignee", or_null(standing.decision.assignee)},
          {"due", or_null(standing.decision.due)},
          {"was", standing.was ? Json(name(*standing.was)) : Json()}};
}

Result<void> write_clash_json(Sink& sink, const Review& review) {
  JsonDocument document(sink, review.options.stop);
  document.member("version", 1);
  document.member("unit", json_unit(review.assembly.unit_in_metres));
  document.member("settings", json_settings(review.options));
  write_tests(document, review);
  write_types(document, review);
  document.list("files", review.file_names.size(), [&](std::size_t i) {
    return Json{{"file", review.assembly.files[i]},
                {"name", review.file_names[i]},
                {"known_as", review.known_names.known_as[i]},
                {"error", error_of(review.assembly, review.assembly.files[i])}};
  });
  document.list("objects", review.parts.size(), [&](std::size_t i) { return json_part(review, i); });
  write_missing(document, review.assembly);
  document.list("pairs", review.clashes.pairs.size(), [&](std::size_t i) { return json_pair(review, i); });
  write_resolved(document, review);
  document.member("decisions", json_decisions(review));
  write_groups(document, review);
  document.member("counts", json_counts(review));
  return document.end();
}

Result<void> write_view_json(Sink& sink, const Assembly& assembly) {
  JsonDocument document(sink);
  document.member("version", 1);
  document.member("unit", json_unit(assembly.unit_in_metres));
  document.member("settings", nullptr);
  document.list("objects", assembly.objects.size(), [&](std::size_t i) {
    Json object = json_identity(assembly, i);
    object.update(Json{{"closed", nullptr}, {"open_edges", nullptr}});
    object.update(json_facts(std::nullopt));
    return object;
  });
  write_missing(document, assembly);
  document.member("pairs", Json::array());
  document.member("counts", nullptr);
  return document.end();
}

}  // namespace impinge::report
