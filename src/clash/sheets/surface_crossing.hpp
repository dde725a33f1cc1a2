// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>

#include "clash/cells_within.hpp"
#include "exact/contact.hpp"

namespace impinge::clash {

/// Whether two surfaces cross somewhere, so that both continue farther than the tolerance on all four sides of a piece
/// of a line or of a common area that is longer than 16 tolerances (docs/verdicts.md). `contact_pairs` is as in
/// cells_within.
bool surfaces_cross(const solid::Part& a, const solid::Part& b, double tolerance, const ContactPairs& contact_pairs,
                    const std::stop_token& stop);

/// The same for places where the order around lines is unknown: those with a triangle in `open_a`, and pairs of small
/// triangles. A place is a set of near pairs connected by common triangles, of two sheets, which are triangles
/// connected by common vertices. The sheets cross there if each has points on both sides of the other, over the other's
/// triangles and not near any of them, and if the place is longer than 16 tolerances: an edge that ends on a face, or
/// reaches through it by no more than the tolerance, does not cross. Sides are propagated between neighbouring
/// triangles; a one-sided surface has none.
bool surfaces_cross_widely(const solid::Part& a, const solid::Part& b, double tolerance,
                           const ContactPairs& contact_pairs, std::span<const std::uint32_t> open_a,
                           const std::stop_token& stop);

/// The same, exactly: two triangles cross, or along a common line or around a common area each sheet is on both sides
/// of the other. `contacts` are all pairs of triangles that share more than a corner.
bool surfaces_cross_exactly(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts);

}  // namespace impinge::clash
