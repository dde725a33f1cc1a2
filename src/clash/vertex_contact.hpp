// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/vec3.hpp"

namespace impinge::clash {

/// Vertex contact: the triangles are within tolerance only near one vertex of each. All points that they share are
/// within an eighth of the tolerance of both corners; where the two corners are the same point, it is the only one.
struct VertexContact {
  std::uint8_t corner_a, corner_b;
  bool is_one_point;
};

/// Nothing where the corners are farther apart than a quarter of the tolerance, or where it is not certain.
std::optional<VertexContact> find_vertex_contact(const Triangle& a, const Triangle& b, double tolerance);

}  // namespace impinge::clash
