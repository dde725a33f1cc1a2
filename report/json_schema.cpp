// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>
#include <vector>

#include "report/json_file.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

using nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

const json& referred(const json& schema, const json& rule) {
  const auto reference = rule.find("$ref");
  return reference == rule.end() ? rule : schema.at(json::json_pointer(reference->get<std::string>().substr(1)));
}

/// The part of a schema that is about one item or member of `value`.
const json& rule_within(const json& schema, const json& rule, const json& value, const std::string& step) {
  if (value.is_array()) return referred(schema, rule.at("items"));
  const auto properties = rule.find("properties");
  const bool is_named = properties != rule.end() && properties->contains(step);
  return referred(schema, is_named ? properties->at(step) : rule.at("additionalProperties"));
}

std::string in_words(const json& value) {
  if (value.is_object() && !value.empty()) return "an object";
  if (value.is_array()) return value.empty() ? "an empty list" : fmt::format("a list of {}", value.size());
  return fit(printable(value.dump().substr(0, 320)), 80);
}

std::string unknown_key(const std::string& key, const json& properties) {
  std::vector<std::string> known;
  for (const auto& [name, rule] : properties.items()) known.push_back(name);
  return fmt::format("there is no '{}' here; did you mean '{}'? The keys are {}",
                     fit(printable(key.substr(0, 320)), 80), nearest_text(key, known), fmt::join(known, ", "));
}

/// What a value does wrong, for which valijson has `found` its own words; an unknown key is added to `place`.
std::string mistake(const json& rule, const json& value, const std::string& found, json::json_pointer& place) {
  if (found.starts_with("Object contains a property")) {
    for (const auto& [key, member] : value.items()) {
      if (rule.at("properties").contains(key)) continue;
      place.push_back(key);
      return unknown_key(key, rule.at("properties"));
    }
  }
  if (found.starts_with("Missing required property")) {
    for (const json& key : rule.at("required"))
      if (!value.contains(key)) return fmt::format("this has no {}", key.dump());
  }
  if (rule.contains("errorMessage"))
    return fmt::format("{}, not {}", rule["errorMessage"].get<std::string>(), in_words(value));
  const json& type = rule.at("type");
  return fmt::format("this must be of type {}, not {}",
                     type.is_array() ? fmt::format("{}", fmt::join(type, " or ")) : type.get<std::string>(),
                     in_words(value));
}

}  // namespace

Result<void> check_against(const json& schema, std::string_view name, const std::string& text, const json& value) {
  valijson::ValidationResults results;
  try {
    valijson::Schema rules;
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(schema), rules);
    if (valijson::Validator().validate(rules, Adapter(value), &results)) return {};
  } catch (const std::exception& problem) {
    return Error{Code::bad_file, fmt::format("{}: this cannot be held against its schema: {}", name, problem.what())};
  }
  // The mistakes of a list's items and an object's members come before what is then said of the list or object.
  const valijson::ValidationResults::Error& first = *results.begin();
  json::json_pointer place;
  const json *rule = &schema, *at = &value;
  for (std::size_t i = 1; i < first.context.size(); ++i) {
    const std::string step = first.context[i].substr(1, first.context[i].size() - 2);  // it is in brackets
    place.push_back(step);
    rule = &rule_within(schema, *rule, *at, step);
    at = at->is_array() ? &at->at(std::stoull(step)) : &at->at(step);
  }
  const std::string what = mistake(*rule, *at, first.description, place);
  return json_error(name, text, place.to_string(), what);
}

}  // namespace impinge::report
