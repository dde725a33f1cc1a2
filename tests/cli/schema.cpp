// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "schema.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace impinge::test {
namespace {

using nlohmann::json;

bool is_of_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "number") return value.is_number();
  if (type == "boolean") return value.is_boolean();
  throw std::runtime_error("type " + type);
}

bool are_members_valid(const json& value, const json& schema, const json& root) {
  if (!value.is_object()) return true;
  const json none = json::object();
  const json& properties = schema.contains("properties") ? schema.at("properties") : none;
  return std::all_of(value.items().begin(), value.items().end(), [&](const auto& item) {
    if (properties.contains(item.key())) return is_valid(item.value(), properties.at(item.key()), root);
    if (!schema.contains("additionalProperties")) return true;
    const json& rest = schema.at("additionalProperties");
    return rest.is_boolean() ? rest.get<bool>() : is_valid(item.value(), rest, root);
  });
}

bool holds(const std::string& keyword, const json& asked, const json& value, const json& schema, const json& root) {
  if (keyword == "type") return is_of_type(value, asked);
  if (keyword == "properties" || keyword == "additionalProperties") return are_members_valid(value, schema, root);
  if (keyword == "required")
    return !value.is_object() ||
           std::all_of(asked.begin(), asked.end(), [&](const json& key) { return value.contains(key); });
  if (keyword == "items")
    return !value.is_array() ||
           std::all_of(value.begin(), value.end(), [&](const json& item) { return is_valid(item, asked, root); });
  if (keyword == "anyOf")
    return std::any_of(asked.begin(), asked.end(), [&](const json& one) { return is_valid(value, one, root); });
  if (keyword == "enum") return std::find(asked.begin(), asked.end(), value) != asked.end();
  if (keyword == "const") return value == asked;
  if (keyword == "minItems") return !value.is_array() || value.size() >= asked;
  if (keyword == "maxItems") return !value.is_array() || value.size() <= asked;
  if (keyword == "minProperties") return !value.is_object() || value.size() >= asked;
  if (keyword == "minLength") return !value.is_string() || !value.get<std::string>().empty();
  if (keyword == "minimum") return !value.is_number() || value >= asked;
  if (keyword == "exclusiveMinimum") return !value.is_number() || value > asked;
  if (keyword == "$ref") return is_valid(value, root.at(json::json_pointer(asked.get<std::string>().substr(1))), root);
  if (keyword == "description" || keyword == "title" || keyword == "$schema" || keyword == "$defs") return true;
  throw std::runtime_error("keyword " + keyword);
}

}  // namespace

bool is_valid(const json& value, const json& schema, const json& root) {
  return std::all_of(schema.items().begin(), schema.items().end(),
                     [&](const auto& keyword) { return holds(keyword.key(), keyword.value(), value, schema, root); });
}

}  // namespace impinge::test
