// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <vector>

#include "impinge/contacts.hpp"
#include "solid/body.hpp"
#include "solid/topology.hpp"

namespace impinge::clash {

/// Pairs of a closed body's own triangles at which it crosses itself along an edge: the edge of one lies, within the
/// tolerance, in the other triangle or on another edge of it, and the surface goes on on all four sides. Then the
/// winding number changes within a shell, so that the sides of its triangles are neither inside nor outside. Floating
/// point suffices, as the surface must go on for many tolerances. In order; incomplete if stopped.
std::vector<TrianglePair> self_edge_crossings(const solid::Body& body, const solid::Topology& topology,
                                              double tolerance, const std::stop_token& stop = {});

}  // namespace impinge::clash
