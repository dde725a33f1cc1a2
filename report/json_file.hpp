// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "impinge/result.hpp"

namespace impinge::report {

/// What a JSON file (RFC 8259) may hold. Nothing nested deeper reaches a function that calls itself.
inline constexpr std::size_t kDeepestJson = 64, kMostJsonValues = 50'000'000;

/// The bytes of a file, of which there must be no more than so many. Errors: `bad_file`, with the name and the reason.
Result<std::string> read_text_file(const std::string& name, std::uint64_t most_bytes);

/// The value of a JSON text; `name` is its file's, for messages. Errors: `bad_file`, with line and column, if the text
/// is no JSON, or has a key twice in one object, is nested too deep, or holds too many values.
/// Members of objects are left out if their keys are not among those that `keeps` wants.
Result<nlohmann::json> parse_json(std::string_view name, const std::string& text,
                                  const std::function<bool(const std::string& key)>& keeps = {},
                                  std::size_t most_values = kMostJsonValues);

/// `bad_file` for a mistake at a JSON pointer (RFC 6901) into a text that `parse_json` has read:
/// "clash.json:12: /tests/0/mode: what is wrong". The text is searched for the line.
Error json_error(std::string_view name, const std::string& text, const std::string& pointer, std::string_view what);

/// Whether the value of a JSON file is what a JSON schema says. Of two schemas that could hold for a value, "anyOf" may
/// choose only where neither looks into the value: rules are found by the place of the mistake alone. Errors:
/// `bad_file`, with the place and the rule: unknown and missing keys by name, else what the rule says as its
/// "errorMessage".
Result<void> check_against(const nlohmann::json& schema, std::string_view name, const std::string& text,
                           const nlohmann::json& value);

/// A value of a JSON file and its place there.
struct JsonNode {
  const nlohmann::json& value;
  nlohmann::json::json_pointer place{};

  [[nodiscard]] JsonNode operator[](const char* key) const { return {value.at(key), place / std::string(key)}; }
  /// The member with this key, if the object has it.
  [[nodiscard]] std::optional<JsonNode> find(const char* key) const {
    return value.contains(key) ? std::optional((*this)[key]) : std::nullopt;
  }
  /// What `read` makes of each item of the list.
  template <class Read>
  [[nodiscard]] auto each(Read read) const {
    std::vector<decltype(read(*this))> all;
    for (std::size_t i = 0; i < value.size(); ++i) all.push_back(read({value[i], place / i}));
    return all;
  }
};

}  // namespace impinge::report
