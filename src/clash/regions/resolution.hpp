// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "clash/regions/regions.hpp"

namespace impinge::clash {

/// What counts as in contact, and as one. Both 0: exactly.
struct Reach {
  double tolerance = 0;
  /// How finely lines of contact and outlines of areas are told: within the tolerance, but also within a quarter of how
  /// wide the triangles in contact are. If more were one point, nothing would be left of their borders.
  double resolution = 0;
};

Reach reach_of(const Side& a, const Side& b, std::span<const exact::Contact> contacts, double tolerance);

}  // namespace impinge::clash
