// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "exact/contact.hpp"
#include "solid/part.hpp"

namespace impinge::solid {

/// Where the open 2-cells of a boundary, cut by another body's boundary, lie in that other body; or-ed bits.
enum Where : std::uint8_t {
  kInside = 1,     ///< in its interior (winding number not 0)
  kOutside = 2,    ///< in its exterior
  kSameSide = 4,   ///< in its boundary, both interiors on one side
  kOtherSide = 8,  ///< in its boundary, the interiors on either side
};

/// The bits of the cells of a (cut by b) and of b (cut by a).
struct Cells {
  std::uint8_t a = 0, b = 0;
};

/// Returns whether no further cell matters.
using Enough = std::function<bool(const Cells&)>;

/// Locates the cells of two solid parts exactly, by rational numbers where points must be constructed. `contacts` are
/// all pairs of triangles that share a point, of any kind. Stops early, with the bits found so far, once
/// `enough(cells)`.
Cells cells_of(const Part& a, const Part& b, std::span<const exact::Contact> contacts, const Enough& enough);

}  // namespace impinge::solid
