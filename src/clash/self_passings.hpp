// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "impinge/contacts.hpp"
#include "solid/body.hpp"
#include "solid/topology.hpp"

namespace impinge::clash {

/// Of pairs of a closed body's own triangles that share a point, those at which it passes through itself along an edge
/// of the one that lies in the other, or on an edge of the other that is not the same: then what it winds around
/// changes within a shell, and there is no inside to a triangle's side. Up to the tolerance, and in floating point:
/// what passes on all four sides farther than that is no matter of rounding.
std::vector<TrianglePair> self_passings(const solid::Body& body, const solid::Topology& topology,
                                        std::span<const TrianglePair> pairs, double tolerance);

}  // namespace impinge::clash
