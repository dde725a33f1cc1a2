// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact.hpp"

namespace oracle {

/// A scene as scenes/scene_file.hpp writes it, its objects placed; nothing if the file is none.
std::optional<std::vector<WorldObject>> read_scene(const std::string& file);

}  // namespace oracle
