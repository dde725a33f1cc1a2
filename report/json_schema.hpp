// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "impinge/result.hpp"

namespace impinge::report {

/// Whether the value of a JSON file is what a JSON schema says. Of two schemas that could hold for a value, "anyOf" may
/// choose only where neither looks into the value: rules are found by the place of the mistake alone. Errors:
/// `bad_file`, with the place and the rule: unknown and missing keys by name, else what the rule says as its
/// "errorMessage".
Result<void> check_against(const nlohmann::json& schema, std::string_view name, const std::string& text,
                           const nlohmann::json& value);

}  // namespace impinge::report
