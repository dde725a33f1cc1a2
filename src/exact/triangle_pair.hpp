// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/vec3.hpp"
#include "impinge/options.hpp"

namespace impinge::exact {

/// How two closed triangles meet (CONTRACT 5, 6), degenerate ones taken as the segment or point that they are.
std::optional<Kind> classify(const Triangle& a, const Triangle& b);

/// Whether two triangles are proper, coplanar, and their interiors meet.
bool share_area(const Triangle& a, const Triangle& b);

}  // namespace impinge::exact
