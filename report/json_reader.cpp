// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/json_reader.hpp"

#include <fmt/format.h>

namespace impinge::report {

JsonReader::JsonReader(const std::string& text, std::string_view name) : text_(text), name_(name) {
  Result<nlohmann::json> value = parse_json(name, text);
  failed_ = !value;
  if (failed_)
    error_ = value.error();
  else
    value_ = *std::move(value);
}

JsonReader::Kind JsonReader::kind() const {
  return at_->is_object()    ? Kind::object
         : at_->is_array()   ? Kind::array
         : at_->is_string()  ? Kind::string
         : at_->is_number()  ? Kind::number
         : at_->is_boolean() ? Kind::boolean
                             : Kind::null;
}

std::set<std::string> JsonReader::keys() const {
  std::set<std::string> keys;
  if (at_->is_object())
    for (const auto& [key, value] : at_->items()) keys.insert(key);
  return keys;
}

bool JsonReader::holds(Kind wanted, std::string_view what) {
  if (kind() != wanted) fail(fmt::format("{} should stand here, not {}", what, at_->type_name()));
  return !failed_;
}

void JsonReader::fail(std::string_view what) {
  if (failed_) return;
  failed_ = true;
  error_ = error_at(path_.to_string(), what);
}

}  // namespace impinge::report
