// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "solid/body.hpp"

namespace impinge::clash {

/// Whether each triangle of one has one of the other with the same corners, up to 2^-42 of the largest coordinate.
/// Their normals may all look the other way; `any_way`: or any of them. Not said once it is stopped.
bool are_same(const solid::Body& a, const solid::Body& b, bool any_way, const std::stop_token& stop);

/// How far two surfaces reach through each other: the largest, over pairs of triangles that cross, exactly, of the
/// least of the four heights that they have on both sides of each other's planes and of the length of the segment that
/// they share: two pipes that stand end to end, off by a rounding, share short segments of walls that go on. Infinity
/// if they are the same.
double surface_reach(const solid::Body& a, const solid::Body& b, const std::stop_token& stop);

}  // namespace impinge::clash
