// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// The JSON of glTF 1 and 2, whatever it holds.
namespace impinge::importer {

/// Whether the name of a file ends as those of glTF do.
bool is_gltf_name(const char* file);

/// The JSON text of a glTF or GLB file; leaves a problem if there is none.
std::string json_text(const char* file, std::string& problem);

/// The member of an object, or null.
const nlohmann::json& member(const nlohmann::json& object, const char* name);

/// The element that a reference names, or null: glTF 2 numbers a list, glTF 1 names the members of an object.
const nlohmann::json& element(const nlohmann::json& list, const nlohmann::json& reference);

/// The roots of the scene that the file shows: references to its nodes, or null.
const nlohmann::json& shown_roots(const nlohmann::json& file);

/// The text of a value, or an empty one; its whole number, or `missing`.
std::string text_of(const nlohmann::json& value);
std::int64_t integer_of(const nlohmann::json& value, std::int64_t missing);

}  // namespace impinge::importer
