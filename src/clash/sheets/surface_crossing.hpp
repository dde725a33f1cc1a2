// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>

#include "clash/cells_within.hpp"
#include "exact/contact.hpp"

namespace impinge::clash {

/// Whether two surfaces go through each other somewhere, farther than the tolerance on all four sides: around a piece
/// of a line, or a common area, that is longer than a point is (docs/verdicts.md). `contact_pairs` is as in
/// cells_within.
bool surfaces_cross(const solid::Part& a, const solid::Part& b, double tolerance, const ContactPairs& contact_pairs,
                    const std::stop_token& stop);

/// The same for what hangs together with those triangles of a about which the rays around a line cannot be told. A
/// place is a set of near pairs that hang together by common triangles, of two sheets: triangles that hang together by
/// common vertices. There, each sheet is on both sides of the other, where it comes within the other's triangles and is
/// not near another of them, and the place is longer than a point is: an edge that ends on a face, or pokes through it
/// by no more than the tolerance, does not pass. Sides are told apart as far as neighbouring triangles hand them on; a
/// one-sided surface has none.
bool surfaces_cross_widely(const solid::Part& a, const solid::Part& b, double tolerance,
                           const ContactPairs& contact_pairs, std::span<const std::uint32_t> open_a,
                           const std::stop_token& stop);

/// The same, exactly: two triangles cross, or somewhere along a common line, or around a common area, each sheet is on
/// both sides of the other. `contacts` are all pairs of triangles that share more than
/// a corner.
bool surfaces_cross_exactly(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts);

}  // namespace impinge::clash
