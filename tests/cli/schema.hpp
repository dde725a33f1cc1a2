// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace impinge::test {

/// Whether a value is what a schema says: of JSON Schema 2020-12 what this project's own schemas use, and an exception
/// for any other keyword.
bool is_valid(const nlohmann::json& value, const nlohmann::json& schema, const nlohmann::json& root);

}  // namespace impinge::test
