// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/vec3.hpp"
#include "exact/integers.hpp"
#include "exact/pair_signs.hpp"
#include "impinge/options.hpp"

namespace impinge::exact {

/// How two closed triangles meet (contract 2.1 to 2.4), degenerate ones taken as the segment or point that they are.
std::optional<Kind> classify(const Triangle& a, const Triangle& b);

/// The same for two triangles of which `signs` holds what is known: at least their boxes and equal vertices have been
/// compared. Points are numbered as in PairSigns. `open` where a triangle is degenerate.
Outcome decide(PairSigns signs, const std::array<IntVec, 6>& points);
/// The same where the points do not fit into integers.
Outcome decide(PairSigns signs, const std::array<Vec3, 6>& points);
/// For pairs with a degenerate triangle.
Outcome decide_degenerate(const std::array<Vec3, 6>& points);

/// Whether two triangles are proper, coplanar, and their interiors meet.
bool share_area(const Triangle& a, const Triangle& b);

}  // namespace impinge::exact
