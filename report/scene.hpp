// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "impinge/scene.hpp"
#include "report/assembly.hpp"

namespace impinge::report {

/// The objects that a word such as those of `--ignore` names: those whose name, or whose label in the table, is the
/// word; only where there is none, those that the word describes as a shell pattern. If it begins with "class:",
/// "file:" or "storey:", those of an IFC class, a file or a storey. Errors: `bad_option`, with the nearest name.
Result<std::vector<std::uint32_t>> objects_named(const Assembly& assembly, std::string_view word);

/// The assembly as a scene that knows which of its objects are near each other; an object's index is its number. Pairs
/// of `ignored` names or patterns are left out, and so are pairs within a group that is not 0; without groups, none.
/// Errors: `bad_option` (a word that names nothing, a pair of words that names no pair, or too many pairs);
/// `bad_pose`, with the object's name.
Result<Scene> scene_of(const Assembly& assembly, const SceneOptions& options,
                       std::span<const std::uint32_t> groups = {});

}  // namespace impinge::report
