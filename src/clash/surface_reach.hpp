// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "solid/body.hpp"

namespace impinge::clash {

/// How far two surfaces reach through each other: the largest, over pairs of triangles that cross, exactly, of the
/// least of the four heights that they have on both sides of each other's planes. Infinity if the surfaces are the same
/// triangles, corners equal to 2^-42 of the largest coordinate.
double surface_reach(const solid::Body& a, const solid::Body& b, const std::stop_token& stop);

}  // namespace impinge::clash
