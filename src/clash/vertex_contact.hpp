// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/vec3.hpp"

namespace impinge::clash {

/// Two triangles that come together in a corner each, and part from there: whatever they share is within an eighth of
/// the tolerance of the corner of either. Where the two corners are the same point, it is all that they share.
struct VertexContact {
  std::uint8_t corner_a, corner_b;
  bool is_one_point;
};

/// Nothing where the corners are farther from each other than a quarter of the tolerance, or it is not certain.
std::optional<VertexContact> find_vertex_contact(const Triangle& a, const Triangle& b, double tolerance);

}  // namespace impinge::clash
