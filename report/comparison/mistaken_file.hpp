// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace impinge::report {

/// What a file is that was given in place of a JSON document, by how it begins: "it is empty", "it is a page, as --html
/// writes it", "it is no JSON object". Empty if a JSON object or list begins there.
std::string what_it_is_instead(std::string_view text);

/// Whether a JSON object with these keys is a glTF file.
bool is_gltf(const std::set<std::string>& keys);

}  // namespace impinge::report
