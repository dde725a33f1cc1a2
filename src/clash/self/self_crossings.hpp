// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/contacts.hpp"
#include "solid/body.hpp"
#include "solid/topology.hpp"

namespace impinge::clash {

/// Whether two of a body's triangles, which meet as `kind` says, keep it from being a solid: they cross, or share an
/// area. With a tolerance, a crossing no deeper or no longer than that is the noise of rounded coordinates (a vertex on
/// a face, an edge across an edge) and no defect.
bool is_defect(const Triangle& a, const Triangle& b, Kind kind, double tolerance);

/// The tolerance for is_defect: at most a quarter of a closed body's wall, since far from the origin the tolerance may
/// exceed the width of a small part whose shells do cross. The wall is that of all shells together, each counted as
/// material: which shells are cavities is found out later.
double defect_tolerance(const solid::Body& body, const solid::Topology& topology, double tolerance);

}  // namespace impinge::clash
