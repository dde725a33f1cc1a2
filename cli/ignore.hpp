// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impinge/scene.hpp"
#include "report/assembly.hpp"

namespace impinge::cli {
using namespace report;

/// The objects that a word such as those of `--ignore` names: those whose name, or whose label in the table, is the
/// word; only where there is none, those that the word describes as a shell pattern. Errors: `bad_option`, with the
/// nearest name.
Result<std::vector<std::uint32_t>> objects_named(const Assembly& assembly, std::string_view word);

/// Leaves out of the scene every pair that `--ignore` names; `ids` are the scene's ids of the assembly's objects.
/// Errors: `bad_option` (a word that names nothing, a pair of words that names no pair, or too many pairs).
Result<void> ignore_pairs(const Assembly& assembly, std::span<const std::pair<std::string, std::string>> ignored,
                          std::span<const ObjectId> ids, Scene& scene);

}  // namespace impinge::cli
