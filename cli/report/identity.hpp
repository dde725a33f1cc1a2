// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "assembly.hpp"

/// Names that clashes keep from one revision of the files to the next.
namespace impinge::cli {

/// For each object what it is known by, whatever its number is: its file's name without folders, its path and its
/// name; and if several have the same, which of them it is.
std::vector<std::string> keys_of(const Assembly& assembly);

/// A UUID (RFC 4122, version 5) that is the same for the same text, as "01234567-89ab-5cde-8f01-23456789abcd".
std::string guid_of(std::string_view text);

/// That of a clash between two objects, in any order; `what` tells several of the same two apart.
std::string guid_of_pair(std::string_view key_a, std::string_view key_b, std::string_view what = {});

}  // namespace impinge::cli
