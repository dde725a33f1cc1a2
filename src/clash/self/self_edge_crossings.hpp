// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <vector>

#include "impinge/contacts.hpp"
#include "solid/body.hpp"
#include "solid/topology.hpp"

namespace impinge::clash {

/// Pairs of a closed body's own triangles that touch or almost do, and at which it passes through itself along an edge
/// of the one that lies in the other, or on an edge of the other that is not the same: then what it winds around
/// changes within a shell, and there is no inside to a triangle's side. Up to the tolerance, and in floating point:
/// what passes on all four sides many times farther than that is no matter of rounding. In order; not all if stopped.
std::vector<TrianglePair> self_edge_crossings(const solid::Body& body, const solid::Topology& topology,
                                              double tolerance, const std::stop_token& stop = {});

}  // namespace impinge::clash
