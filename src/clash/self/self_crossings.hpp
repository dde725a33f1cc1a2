// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/contacts.hpp"
#include "solid/body.hpp"
#include "solid/topology.hpp"

namespace impinge::clash {

/// Whether two of a body's triangles, of which `kind` says how they meet, make it less than a solid: they cross, or
/// share an area. With a tolerance, a crossing no deeper or no longer than that is the noise of rounded coordinates (a
/// vertex on a face, an edge across an edge) and does no harm.
bool is_defect(const Triangle& a, const Triangle& b, Kind kind, double tolerance);

/// A tolerance for that, or as much of it as is no more than a quarter of a closed body's wall: far from the origin
/// the tolerance is more than a small part is wide, and its shells run through each other all the same. The wall is
/// that of all shells together, each counted as material, since which of them are cavities is not known yet.
double defect_tolerance(const solid::Body& body, const solid::Topology& topology, double tolerance);

}  // namespace impinge::clash
